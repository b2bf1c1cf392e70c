// Short names of what a measurement was made of: they change when it does.
#pragma once

#include <filesystem>
#include <string>

#include "runtime/scene/camera.h"

namespace nightcity::experiments {

/// Returns 16 hexadecimal digits over the bytes of SCENE.glb and SCENE.lights.
std::string fingerprint_scene(const std::filesystem::path& glb);

/// Returns 8 hexadecimal digits of a camera.
std::string fingerprint_pose(const scene::CameraPose& pose);

}  // namespace nightcity::experiments
