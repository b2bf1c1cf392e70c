// How hands move the eye: pure functions from pose to pose, for mouse and keys alike.
#pragma once

#include <glm/vec3.hpp>

#include "runtime/scene/camera.h"

namespace nightcity {

/// All motions keep Y up and the view at most 89 degrees from the horizon, where "left" would lose its
/// meaning; a pose that starts steeper (a map) keeps its heading and is brought there by the first turn.
constexpr float max_elevation_deg = 89.0f;

/// The eye goes round the target, at its distance: `yaw` counter-clockwise seen from above, `pitch` upwards;
/// radians.
CameraPose orbited(const CameraPose& pose, float yaw, float pitch);

/// The eye stays, the target goes round it: `yaw` to the left, `pitch` upwards; radians.
CameraPose turned(const CameraPose& pose, float yaw, float pitch);

/// Eye and target move by metres along the view's right, up and forward.
CameraPose moved(const CameraPose& pose, const glm::vec3& right_up_forward);

/// The distance from eye to target becomes `factor` times itself, within 0.5 m to 100 km.
CameraPose dollied(const CameraPose& pose, float factor);

}  // namespace nightcity
