// Draws over the picture, besides the panel: caption, notices, licences, help, markers.
#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "runtime/scene/camera.h"
#include "runtime/viewer/notices.h"
#include "runtime/viewer/panel.h"
#include "runtime/viewer/pick.h"

namespace nightcity::viewer {

/// Draws the caption at the bottom left, the licences above it, and notices above them.
void draw_lines(const ViewerState& state, const FrameStats& stats, const Notices& notices,
                const glm::vec2& window);

/// Draws a text in the middle, while there is no picture.
void draw_middle(const std::string& text, const glm::vec2& window);

/// Draws what was picked, in a window of its own, and a line from the point to each of the lights.
/// `luminance_cd_m2`: of the picture there.
void draw_pick(std::optional<Pick>& picked, double luminance_cd_m2, const scene::RenderScene& scene,
               const scene::CameraPose& pose, const glm::vec2& window);

/// Draws the list of keys and gestures.
void draw_help(bool& open, const glm::vec2& window);

/// Draws a ring at each lamp that is seen, within bounds of their number: more would cover the
/// picture. Windows have none, nor have lamps behind walls.
void draw_markers(const scene::RenderScene& scene, const scene::CameraPose& pose,
                  const glm::vec2& window);

/// Returns the line at the bottom of the window: what made the picture and what goes on; "" before
/// there is a scene.
std::string make_bottom_line(const ViewerState& state, const FrameStats& stats);

/// Returns how far caption and licences reach up from the bottom of the window (pixels): nothing
/// may cover them for good, for licences ask to be named.
float measure_lines(const ViewerState& state, const FrameStats& stats, const glm::vec2& window);

/// Closes the innermost thing that is open in the panel: a drop-down list, a text box. Returns
/// whether there was one.
bool close_innermost();

}  // namespace nightcity::viewer
