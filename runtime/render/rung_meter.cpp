#include "runtime/render/rung_meter.h"

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "runtime/measure/noise.h"

namespace nightcity::render {
namespace {

constexpr std::uint32_t seeds = 3;
constexpr std::size_t lead_frames = 4;

}  // namespace

std::vector<Moment> at_rest(const scene::CameraPose& pose, double time_s) {
  return std::vector<Moment>(rung_frames, Moment{pose, time_s});
}

std::vector<Moment> moving_aside(const scene::CameraPose& pose, double time_s, double step_m) {
  std::vector<Moment> moments = at_rest(pose, time_s);
  const glm::vec3 right = glm::normalize(glm::cross(pose.target - pose.position, pose.up));
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const glm::vec3 offset = static_cast<float>(step_m * static_cast<double>(i)) * right;
    moments[i].pose.position += offset;
    moments[i].pose.target += offset;
  }
  return moments;
}

RungMeter::RungMeter(std::unique_ptr<Renderer> renderer, std::vector<std::vector<Moment>> places,
                     const RenderSettings& settings, std::vector<Rung> rungs, bool errors)
    : renderer_(std::move(renderer)),
      places_(std::move(places)),
      settings_(settings),
      errors_(errors),
      rungs_(std::move(rungs)) {
  settings_.averaging.accumulate = false;  // every frame stands alone, as in a flight
}

bool RungMeter::work(double slice_s, double wait_s) {
  if (is_done()) return true;
  if (!renderer_->wait(wait_s)) return false;
  if (!renderer_->has_begun()) {
    const Moment& moment = places_[place_].at(frame_);
    RenderSettings settings = settings_;
    settings.sampling.seed += seed_;
    settings.time_s = moment.time_s;
    renderer_->begin_frame(moment.pose, settings, rungs_[rung_].effort);
  }
  if (!renderer_->continue_frame(slice_s, wait_s)) return false;
  complete_frame();
  return is_done();
}

void RungMeter::complete_frame() {
  if (frame_ >= lead_frames) ms_.push_back(gpu::sum_ms(renderer_->timings()));
  if (++frame_ < places_[place_].size()) return;
  frame_ = 0;
  if (errors_) pictures_.push_back(renderer_->download(false));
  if (++seed_ < (errors_ ? seeds : 1)) return;
  seed_ = 0;
  complete_place();
}

void RungMeter::complete_place() {
  Rung& rung = rungs_[rung_];
  std::sort(ms_.begin(), ms_.end(), std::greater<>());
  rung.ms = std::max(rung.ms, ms_.at(1));
  // A picture that is upscaled or filled has less noise, and errors that no other seed shows.
  if (errors_ && (rung.effort.resolution_scale < 1 || rung.effort.half_rate))
    rung.relative_error = std::numeric_limits<double>::infinity();
  else if (errors_)
    rung.relative_error = std::max(rung.relative_error, measure::find_relative_noise(pictures_));
  ms_.clear();
  pictures_.clear();
  if (++place_ < places_.size()) return;
  place_ = 0;
  ++rung_;
}

std::vector<Rung> RungMeter::take() {
  // Less work takes no longer: where it seemed to, something else held the device up.
  for (std::size_t i = rungs_.size() - 1; i > 0; --i)
    rungs_[i - 1].ms = std::min(rungs_[i - 1].ms, rungs_[i].ms);
  return std::move(rungs_);
}

}  // namespace nightcity::render
