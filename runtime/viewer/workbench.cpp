#include "runtime/viewer/workbench.h"

#include <fmt/format.h>

#include <utility>

#include "runtime/render/parse.h"

namespace nightcity::viewer {

void Workbench::open(std::unique_ptr<Opening> opening) {
  if (opening_) return;
  opening_ = std::move(opening);
  opening_->set_device(device_);
}

bool Workbench::finish_opening(glm::uvec2 window) {
  if (!opening_ || !opening_->is_done() || (picture_ && picture_->is_busy())) return false;
  const std::unique_ptr<Opening> done = std::move(opening_);
  std::unique_ptr<City> city = done->take();
  job_.reset();
  picture_.reset();  // before the scene that it renders
  city_ = std::move(city);
  picture_ = std::make_unique<LivePicture>(device_, passes_, *city_->on_device, window);
  return true;
}

void Workbench::save(const View& view, const PictureQuality& quality) {
  picture_->stop();  // the job switches the scene's lights to its own time
  job_ = std::make_unique<PictureJob>(device_, passes_, *city_->on_device, view, quality);
}

measure::Image Workbench::take_saved() {
  const std::unique_ptr<PictureJob> job = std::move(job_);
  measure::Image image = job->download();
  image.info.licences = scene::describe_licences(city_->scene);
  image.info.camera = scene::to_text(job->pose());
  image.info.time = render::time_text(job->settings().time_s);
  return image;
}

bool Workbench::is_busy() const {
  return (picture_ && picture_->is_busy()) || (job_ && job_->is_busy());
}

bool Workbench::wait(double wait_s) {
  if (picture_ && picture_->is_busy() && !picture_->wait(wait_s)) return false;
  return !job_ || !job_->is_busy() || job_->wait(wait_s);
}

bool Workbench::has_work(const View& view, double now_s) const {
  return job_ || (picture_ && !picture_->rests(view, now_s));
}

Workbench::Result Workbench::work(const View& view, bool still, double now_s, double wait_s) {
  const bool job_next = still && picture_->shows(view);
  if (job_ && !picture_->is_busy() && (job_->is_busy() || job_next)) {
    picture_->stop();  // the vehicles of the scene stand where the job has them
    return job_->work(wait_s) ? Result::saved : Result::nothing;
  }
  return picture_->work(view, now_s, wait_s) ? Result::picture : Result::nothing;
}

void Workbench::stop() {
  if (picture_) picture_->stop();
}

std::string Workbench::describe() const {
  if (opening_) {
    const std::string stage = fmt::format("{}, {:.0f} s", opening_->stage(), opening_->elapsed_s());
    return city_ ? fmt::format("opening {}: {}", name_of(opening_->path()), stage) : stage;
  }
  if (job_) return job_->progress();
  if (!picture_) return "";
  if (picture_->compiles()) return "compiling shaders";
  if (picture_->is_fine() || picture_->share_done() <= 0) return "";
  const std::uint32_t divisor = picture_->plan().divisor;
  return fmt::format(
      "refining, {:.0f} % of {}", 100 * picture_->share_done(),
      divisor == 1 ? "every pixel" : fmt::format("one pixel in {}", divisor * divisor));
}

}  // namespace nightcity::viewer
