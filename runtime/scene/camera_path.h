// A way through a scene for the eye: a smooth curve through poses.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene/camera.h"

namespace nightcity {

class CameraPath {
 public:
  /// At least one pose; passed one after the other at equal shares of the way. Throws Error without any.
  explicit CameraPath(std::vector<CameraPose> poses);

  /// u in [0, 1], clamped: positions and targets on a Catmull-Rom curve, `up` and field of view of the
  /// nearest pose.
  CameraPose at(double u) const;

 private:
  std::vector<CameraPose> poses_;
};

/// "orbit" (round the lit part of the city, a quarter turn), "dive" (from the overview down to the street) or
/// "street" (along the street of the preset of that name); anything else is a JSON file {"poses": [pose,
/// ...]}, each pose as find_camera has it. Throws Error.
CameraPath find_path(const std::string& preset_or_file, const RenderScene& scene);

/// Names find_path knows.
const std::vector<std::string>& path_presets();

}  // namespace nightcity
