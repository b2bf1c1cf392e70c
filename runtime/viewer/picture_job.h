// A picture that is being rendered to be saved, beside the one that the window shows.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "runtime/measure/image.h"
#include "runtime/render/renderer.h"
#include "runtime/viewer/live_picture.h"

namespace nightcity::viewer {

/// The quality of saved pictures.
struct PictureQuality {
  std::uint32_t frames = 16;            // averaged, with all samples of the settings
  std::uint32_t width = 0, height = 0;  // 0: the window's size when the picture was asked for
};

struct SavedPicture {
  measure::Image image;
  measure::Image8 shown;  // as it is looked at
};

/// Writes a picture as night-NNN.png and .exr into `folder`, with its `info` in both. Returns the
/// sentence that says where they are. Throws Error.
std::string save_picture(const std::filesystem::path& folder, const SavedPicture& picture);

class PictureJob {
 public:
  /// Renders `view` as it is now. Throws Error without memory.
  PictureJob(gpu::Device& device, render::PassLibrary& passes, render::DeviceScene& scene,
             const View& view, const PictureQuality& quality);

  /// Works a slice, and waits for it at most `wait_s`. Returns whether all frames are there.
  bool work(double wait_s);
  bool is_busy() const { return renderer_.is_busy(); }
  bool wait(double wait_s) { return renderer_.wait(wait_s); }
  /// Returns "saving a picture of 1280 x 720: frame 3 of 16, 20 s left".
  std::string progress() const;
  const render::RenderSettings& settings() const { return settings_; }
  const scene::CameraPose& pose() const { return pose_; }
  /// Returns the picture, shown as these settings say.
  SavedPicture download(const render::DisplaySettings& display);

 private:
  bool is_done() const;

  const render::DeviceScene& scene_;
  render::Renderer renderer_;
  scene::CameraPose pose_;
  render::RenderSettings settings_;
  glm::uvec2 size_;
  std::uint32_t frames_;
};

}  // namespace nightcity::viewer
