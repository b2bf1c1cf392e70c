// Checks that hold for every file of cameras, broken or not: for the fuzz target and the test of
// its corpus.
#pragma once

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "formats/error.h"
#include "formats/finite.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/camera_path.h"

namespace nightcity::test {

/// Returns what is wrong with a pose that was read; "" where nothing is.
inline std::string find_fault_of_pose(const scene::CameraPose& pose) {
  if (!finite(pose.position) || !finite(pose.target) || !finite(pose.up)) return "a number";
  const gpu::Camera camera = scene::make_camera(pose, 1.5f);
  for (const glm::vec3& axis : {camera.forward, camera.right, camera.up})
    if (!(std::abs(glm::length(axis) - 1) < 1e-3f)) return "an axis";
  if (std::abs(glm::dot(camera.forward, camera.right)) > 1e-3f) return "the angle of axes";
  if (!(camera.tan_half_height > 0 && std::isfinite(camera.tan_half_height))) return "the lens";
  return "";
}

/// Returns what is wrong with how a file is read, as one pose and as a path; "" where it is sound,
/// or refused with a reason.
inline std::string find_fault_of_cameras(const std::filesystem::path& path,
                                         const std::string& text) {
  std::string fault;
  const auto read = [&](const auto& reader) {
    try {
      reader();
    } catch (const Error& error) {
      if (std::string(error.what()).empty()) fault = "an error without words";
    }
  };
  read([&] {
    const scene::CameraPose pose = scene::parse_camera(text, "camera");
    fault = find_fault_of_pose(pose);
    const scene::CameraPose again = scene::parse_camera(scene::to_text(pose), "the same");
    if (again.position != pose.position || again.target != pose.target || again.up != pose.up ||
        again.fov_deg != pose.fov_deg)
      fault = "a pose that is written and read";
  });
  read([&] {
    const glm::dvec3 origin(1000, 20, -3000);
    const std::vector<scene::CameraPose> poses = scene::read_poses(path, origin);
    for (const scene::CameraPose& pose : poses)
      if (fault.empty()) fault = find_fault_of_pose(pose);
    const scene::CameraPath along(poses);
    const scene::CameraPose first = along.at(0), last = along.at(1);
    if (first.position != poses.front().position || last.position != poses.back().position)
      fault = "the ends of a path";
  });
  return fault;
}

}  // namespace nightcity::test
