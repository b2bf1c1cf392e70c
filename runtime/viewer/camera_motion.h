// Camera motions for mouse and keyboard, as pure functions from pose to pose.
#pragma once

#include <glm/vec3.hpp>

#include "runtime/scene/camera.h"

namespace nightcity::viewer {

/// Returns whether two poses relative to one origin show the same view.
bool is_same_pose(const scene::CameraPose& a, const scene::CameraPose& b);

/// All motions keep Y up and the view at most 89 degrees from the horizon, because straight up or
/// down "left" has no meaning. The first turn brings a steeper pose (a map) to that limit and keeps
/// its heading.
constexpr float max_elevation_deg = 89.0f;

/// Returns the pose after the camera moved around its target at the same distance: by `yaw`
/// counter-clockwise seen from above and by `pitch` upwards, in radians.
scene::CameraPose orbited(const scene::CameraPose& pose, float yaw, float pitch);

/// The same around another point. Where the camera is to look at it, `pivot` is its target.
scene::CameraPose orbited(const scene::CameraPose& pose, const glm::vec3& pivot, float yaw,
                          float pitch);

/// Returns the pose after the camera turned in its place: by `yaw` to the left and by `pitch`
/// upwards, in radians.
scene::CameraPose turned(const scene::CameraPose& pose, float yaw, float pitch);

/// Returns the pose with camera and target moved along the view's right, up and forward, in metres.
scene::CameraPose moved(const scene::CameraPose& pose, const glm::vec3& right_up_forward);

/// Returns the pose with the distance from camera to target multiplied by `factor`, within 0.5 m to
/// 100 km.
scene::CameraPose dollied(const scene::CameraPose& pose, float factor);

/// Returns the pose with the distance from camera to `point` multiplied by `factor`, within 0.2 m
/// to 100 km. The view direction and the point's place in the picture stay; the target moves to the
/// point's depth.
scene::CameraPose zoomed(const scene::CameraPose& pose, const glm::vec3& point, float factor);

}  // namespace nightcity::viewer
