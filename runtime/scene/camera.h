// Where the eye stands: from a file, or a preset found from the scene itself.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "runtime/scene/render_scene.h"

namespace nightcity {

struct CameraPose {
  glm::vec3 position{0, 10, 0};  // model space, m
  glm::vec3 target{0, 0, -100};
  glm::vec3 up{0, 1, 0};
  float fov_deg = 60;  // vertical
};

/// The shaders' camera. Throws Error when position and target coincide, `up` is along the view, or fov is not
/// in (0, 179].
gpu::Camera make_camera(const CameraPose& pose, float aspect);

/// "overview" (the lit part of the city, from the south-west), "street" (a pedestrian's eye between lamps) or
/// "top" (a map); anything else is a JSON file {"position": [x, y, z], "target": [...], "up": [...],
/// "fov_deg": f}. Throws Error.
CameraPose find_camera(const std::string& preset_or_file, const RenderScene& scene);

/// Names find_camera knows.
const std::vector<std::string>& camera_presets();

void write_camera(const std::filesystem::path& file, const CameraPose& pose);

}  // namespace nightcity
