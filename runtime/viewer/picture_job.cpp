#include "runtime/viewer/picture_job.h"

#include <fmt/format.h>

#include "formats/program/progress_display.h"
#include "runtime/measure/exr.h"
#include "runtime/measure/png.h"
#include "runtime/viewer/picture_names.h"

namespace nightcity::viewer {
namespace {

constexpr double picture_slice_s = 0.025;

glm::uvec2 size_of(const View& view, const PictureQuality& quality) {
  return quality.width == 0 ? view.window : glm::uvec2(quality.width, quality.height);
}

}  // namespace

std::string save_picture(const std::filesystem::path& folder, const SavedPicture& picture) {
  const measure::Image& image = picture.image;
  const std::string stem = save_under_next_name(
      folder, {".png", ".exr"},
      [&](const std::filesystem::path& file, const std::string& extension) {
        if (extension == ".exr")
          measure::write_exr(file, image);
        else
          measure::write_png(file, picture.shown, measure::png_text(image.info));
      });
  std::error_code ignored;
  const std::filesystem::path whole = std::filesystem::weakly_canonical(folder, ignored) / stem;
  return fmt::format("saved {0}.png and {1}.exr: {2} x {3} pixels, mean of {4} frame{5}",
                     whole.string(), stem, image.width, image.height, image.info.frames,
                     image.info.frames == 1 ? "" : "s");
}

PictureJob::PictureJob(gpu::Device& device, render::PassLibrary& passes, render::DeviceScene& scene,
                       const View& view, const PictureQuality& quality)
    : scene_(scene),
      renderer_(device, passes, scene, size_of(view, quality).x, size_of(view, quality).y),
      pose_(view.pose),
      settings_(view.settings),
      size_(size_of(view, quality)),
      frames_(quality.frames) {
  settings_.averaging = {};
  // A picture that is kept has every pixel, each sampled in every frame.
  settings_.sampling.resolution_scale = 1;
  settings_.sampling.half_rate = false;
}

SavedPicture PictureJob::download(const render::DisplaySettings& display) {
  SavedPicture picture{renderer_.download(), {}};
  picture.image.info.ev100 = display.ev100;
  picture.image.info.eye = render::describe_eye(display);
  picture.shown = renderer_.develop(picture.image, display);
  return picture;
}

bool PictureJob::work(double wait_s) {
  if (!renderer_.wait(wait_s)) return false;
  if (!renderer_.has_begun()) {
    if (is_done()) return true;
    renderer_.begin_frame(pose_, settings_);
  }
  renderer_.continue_frame(picture_slice_s, wait_s);
  return !renderer_.has_begun() && is_done();
}

// Lights that are about to be switched are those of another view: they count anew after that.
bool PictureJob::is_done() const {
  return renderer_.frames() >= frames_ && !scene_.switching();
}

std::string PictureJob::progress() const {
  std::string text = fmt::format("saving a picture of {} x {}: frame {} of {}", size_.x, size_.y,
                                 std::min(renderer_.frames() + 1, frames_), frames_);
  if (renderer_.frames() > 0) {
    const double left_s =
        renderer_.frame_s() * (frames_ - renderer_.frames() - renderer_.share_done());
    text += ", " + program::format_duration(std::chrono::duration<double>(left_s)) + " left";
  }
  return text + " (Esc stops)";
}

}  // namespace nightcity::viewer
