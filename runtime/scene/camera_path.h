// A camera's path through a scene: a smooth curve through poses.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/scene/camera.h"

namespace nightcity::scene {

class CameraPath {
 public:
  /// The path passes the poses one after the other at equal steps of u. Throws Error if there are
  /// none.
  explicit CameraPath(std::vector<CameraPose> poses);

  /// Returns the pose at u, clamped to [0, 1]: position and target on a Catmull-Rom curve, `up` and
  /// field of view of the nearest pose.
  CameraPose at(double u) const;

 private:
  std::vector<CameraPose> poses_;
};

/// Returns a preset's path: "orbit" (a quarter turn around the lit part of the city), "dive" (from
/// the overview down to the street) or "street" (along the street of the camera preset of that
/// name). Any other name is a JSON file {"poses": [pose, ...]} with poses as in find_camera's
/// files. Throws Error.
CameraPath find_path(const std::string& preset_or_file, const RenderScene& scene);

/// Returns the poses of a JSON file {"poses": [pose, ...]}, relative to `origin`. Throws Error with
/// the file's name.
std::vector<CameraPose> read_poses(const std::filesystem::path& file, const glm::dvec3& origin);
/// Writes such a file. Throws Error.
void write_poses(const std::filesystem::path& file, const std::vector<CameraPose>& poses);

/// Returns the names of the presets.
const std::vector<std::string>& path_presets();

}  // namespace nightcity::scene
