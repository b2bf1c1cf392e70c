// Records the way of the camera, as a path that `nightview record` and `flight` take.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/scene/camera.h"

namespace nightcity::viewer {

class PathRecorder {
 public:
  /// The poses of a path follow each other at this interval, s.
  static constexpr double step_s = 0.25;

  /// Starts, or finishes a recording that goes on. Returns the sentence that says so. Throws Error.
  std::string toggle(const std::filesystem::path& scene, double now_s);

  bool is_recording() const { return is_recording_; }
  void start(double now_s);
  /// Keeps the pose, once for each interval that has passed.
  void follow(const scene::CameraPose& pose, double now_s);
  /// Returns the file of the last path that was recorded, "" before the first.
  const std::filesystem::path& file() const { return file_; }
  double duration_s() const { return poses_.empty() ? 0 : step_s * double(poses_.size() - 1); }
  /// Ends the recording and writes it beside `scene` as NAME.path-NNN.json, under the next number
  /// that is free. Returns the sentence that says where it is and how it is rendered. Throws Error.
  std::string finish(const std::filesystem::path& scene);

 private:
  bool is_recording_ = false;
  double next_s_ = 0;
  std::vector<scene::CameraPose> poses_;
  std::filesystem::path file_;
};

}  // namespace nightcity::viewer
