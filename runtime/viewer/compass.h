// Draws a compass and a scale bar over the picture.
#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "runtime/viewer/controls.h"

namespace nightcity::viewer {

/// A length that a bar of the map shows.
struct ScaleBar {
  double metres = 0;
  float pixels = 0;
};

/// Returns the longest of 1, 2, 5, 10, ... m that takes at most `most_px` pixels at the distance
/// that the camera looks at, across a picture `height_px` pixels high.
ScaleBar find_scale_bar(const scene::CameraPose& pose, float distance_m, float height_px,
                        float most_px);

/// Returns the direction in which a camera looks, in degrees from north over east, 0 .. 360.
double find_bearing(const scene::CameraPose& pose);

/// Draws a needle to the north at the upper right, and a bar at the bottom that is as long as so
/// many metres at what the camera turns about.
void draw_compass(const CameraControl& camera, const glm::vec2& window);

}  // namespace nightcity::viewer
