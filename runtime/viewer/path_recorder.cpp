#include "runtime/viewer/path_recorder.h"

#include <fmt/format.h>

#include "formats/error.h"
#include "runtime/scene/camera_path.h"

namespace nightcity::viewer {
namespace {

constexpr std::size_t max_poses = 4 * 3600;  // an hour
constexpr int max_files = 1000;

}  // namespace

std::string PathRecorder::toggle(const std::filesystem::path& scene, double now_s) {
  if (is_recording_) return finish(scene);
  start(now_s);
  return "recording the camera's way: R ends it";
}

void PathRecorder::start(double now_s) {
  is_recording_ = true;
  next_s_ = now_s;
  poses_.clear();
}

void PathRecorder::follow(const scene::CameraPose& pose, double now_s) {
  for (; is_recording_ && next_s_ <= now_s && poses_.size() < max_poses; next_s_ += step_s)
    poses_.push_back(pose);
}

std::string PathRecorder::finish(const std::filesystem::path& scene) {
  is_recording_ = false;
  if (poses_.size() < 2) throw Error("path", "nothing is recorded: it lasted less than a step");
  std::filesystem::path file;
  for (int number = 1; number < max_files; ++number) {
    file = scene;
    file.replace_extension(fmt::format(".path-{:03}.json", number));
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) break;
  }
  scene::write_poses(file, poses_);
  file_ = file;
  return fmt::format(
      "{:.1f} s recorded: Ctrl+R films it here, nightview record {} --path {} --duration {:g} "
      "--out film elsewhere",
      duration_s(), scene.filename().string(), file.string(), duration_s());
}

}  // namespace nightcity::viewer
