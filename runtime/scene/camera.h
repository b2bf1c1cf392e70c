// The camera's pose: from a file, or a preset that is found from the scene itself.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "runtime/scene/render_scene.h"
#include "shaders/frame.h"

namespace nightcity::scene {

struct CameraPose {
  glm::vec3 position{0, 10, 0};  // relative to `origin`, m
  glm::vec3 target{0, 0, -100};
  glm::vec3 up{0, 1, 0};
  float fov_deg = 60;    // vertical
  glm::dvec3 origin{0};  // in model space, m, as RenderScene's
};

/// Returns the same pose relative to another origin.
CameraPose relative_to(const glm::dvec3& origin, const CameraPose& pose);

/// Returns the shaders' camera. Throws Error if position and target coincide, `up` is along the
/// view, or the field of view is not in (0, 179] degrees.
gpu::Camera make_camera(const CameraPose& pose, float aspect);

/// Returns the unit direction of a perspective camera's ray through a place of its picture, -1 to 1
/// to the right and downwards.
glm::vec3 direction_through(const gpu::Camera& camera, const glm::vec2& place);

/// Returns a preset's pose: "overview" (the lit part of the city, from the south-west), "street" (a
/// pedestrian's view along a street) or "top" (a map). "street:NAME" is such a view along the
/// street of that name, of which a part is enough (named_street_view.h). Text that begins with a
/// brace is a pose as to_text() gives it: {"position": [x, y, z], "target": [...], "up": [...],
/// "fov_deg": f}. Any other name is a file that holds such a text. Throws Error.
CameraPose find_camera(const std::string& preset_or_file, const RenderScene& scene);

/// Returns the names of the presets.
const std::vector<std::string>& camera_presets();

/// Returns the pose as one line of text, which find_camera takes and camera files hold.
std::string to_text(const CameraPose& pose);
/// Returns the pose that `text` holds, in model space, relative to `origin`. `source` names it in
/// messages. Throws Error where it is none.
CameraPose parse_camera(const std::string& text, const std::string& source,
                        const glm::dvec3& origin = glm::dvec3(0));

void write_camera(const std::filesystem::path& file, const CameraPose& pose);

}  // namespace nightcity::scene
