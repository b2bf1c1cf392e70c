#include "runtime/viewer/workbench.h"

#include <fmt/format.h>

#include <utility>

#include "runtime/render/parse.h"

namespace nightcity::viewer {

void Workbench::open(std::unique_ptr<Opening> opening) {
  if (opening_) return;
  opening_ = std::move(opening);
  opening_->set_device(device_, passes_);
}

bool Workbench::finish_opening(glm::uvec2 window) {
  if (!opening_ || !opening_->is_done() || (picture_ && picture_->is_busy())) return false;
  const std::unique_ptr<Opening> done = std::move(opening_);
  std::unique_ptr<City> city = done->take();
  job_.reset();
  picture_.reset();  // before the scene that it renders
  other_.reset();
  city_ = std::move(city);
  picture_ = std::make_unique<LivePicture>(device_, passes_, *city_->on_device, window);
  return true;
}

void Workbench::hold_beside(Beside what) {
  if ((what == beside_ && (other_ != nullptr) == (what != Beside::nothing)) || !city_) return;
  stop();
  beside_ = what;
  other_.reset();
  turn_of_other_ = false;
  if (what != Beside::nothing)
    other_ = std::make_unique<LivePicture>(device_, passes_, *city_->on_device, glm::uvec2(1));
}

void Workbench::expose(const render::DisplaySettings& display) {
  if (!picture_) return;
  picture_->expose(display, beside(Beside::reference));
  if (beside_ == Beside::side && other_ && !other_->is_busy()) other_->expose(display);
}

void Workbench::save(const View& view, const PictureQuality& quality) {
  stop();  // the job switches the scene's lights to its own time
  job_ = std::make_unique<PictureJob>(device_, passes_, *city_->on_device, view, quality);
}

SavedPicture Workbench::take_saved(const render::DisplaySettings& display) {
  const std::unique_ptr<PictureJob> job = std::move(job_);
  SavedPicture picture = job->download(display);
  measure::Image& image = picture.image;
  image.info.licences = scene::describe_licences(city_->scene);
  image.info.camera = scene::to_text(job->pose());
  image.info.time = render::time_text(job->settings().time_s);
  return picture;
}

bool Workbench::is_busy() const {
  return passes_.is_busy() || (picture_ && picture_->is_busy()) || (other_ && other_->is_busy()) ||
         (job_ && job_->is_busy());
}

bool Workbench::wait(double wait_s) {
  for (LivePicture* picture : {picture_.get(), other_.get()})
    if (picture && picture->is_busy() && !picture->wait(wait_s)) return false;
  return !job_ || !job_->is_busy() || job_->wait(wait_s);
}

bool Workbench::has_work(const Views& views, double now_s) const {
  return job_ || (picture_ && !picture_->rests(views.view, now_s)) ||
         (other_ && views.other && !other_->rests(*views.other, now_s));
}

// Frames of the two are never mixed: lights may be switched between them.
LivePicture& Workbench::choose(const Views& views, double now_s) {
  if (!other_ || !views.other) return *picture_;
  if (beside_ == Beside::reference && !picture_->shows(views.view)) {
    other_->stop();  // a frame of it may take minutes: the picture comes first
    return *picture_;
  }
  if (picture_->has_begun()) return *picture_;
  if (other_->has_begun()) return *other_;
  if (views.same_lights || !city_->on_device->switching()) {
    // Tables of lights are those of the side whose turn it is: the other one does not wait for
    // them.
    View view = views.view, other = *views.other;
    if (!views.same_lights) view.switches = other.switches = false;
    const bool first = !picture_->rests(view, now_s), second = !other_->rests(other, now_s);
    turn_of_other_ = second && (!first || (views.same_lights && !turn_of_other_));
  }
  return turn_of_other_ ? *other_ : *picture_;
}

Workbench::Result Workbench::work(const Views& views, bool still, double now_s, double wait_s) {
  const bool busy = picture_->is_busy() || (other_ && other_->is_busy());
  if (job_ && !busy && (job_->is_busy() || (still && picture_->shows(views.view)))) {
    stop();  // the vehicles of the scene stand where the job has them
    return job_->work(wait_s) ? Result::saved : Result::nothing;
  }
  LivePicture& next = choose(views, now_s);
  const View& view = &next == picture_.get() ? views.view : *views.other;
  return next.work(view, now_s, wait_s) ? Result::picture : Result::nothing;
}

void Workbench::stop() {
  if (picture_) picture_->stop();
  if (other_) other_->stop();
}

std::string Workbench::describe() const {
  if (opening_) {
    const std::string stage = fmt::format("{}, {:.0f} s", opening_->stage(), opening_->elapsed_s());
    return city_ ? fmt::format("opening {}: {}", name_of(opening_->path()), stage) : stage;
  }
  if (job_) return job_->progress();
  if (!picture_) return "";
  if (picture_->compiles()) return "compiling shaders";
  if (picture_->pace().is_measuring()) return picture_->pace().describe();
  if (other_ && turn_of_other_ && other_->has_begun())
    return beside_ == Beside::reference ? "rendering the reference" : "rendering the other side";
  if (picture_->is_fine() || picture_->share_done() <= 0) return "";
  const std::uint32_t divisor = picture_->plan().divisor;
  return fmt::format(
      "refining, {:.0f} % of {}", 100 * picture_->share_done(),
      divisor == 1 ? "every pixel" : fmt::format("one pixel in {}", divisor * divisor));
}

}  // namespace nightcity::viewer
