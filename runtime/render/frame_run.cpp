#include "runtime/render/frame_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace nightcity::render {
namespace {

// Steps in one submission of an infinite slice: long enough to hide the cost of submitting, short
// enough that no window system or driver watchdog believes that the device hangs.
constexpr std::size_t max_steps = 16;

// A step of unknown cost begins with this share of its parts.
constexpr std::uint32_t first_share = 64;
// A slice holds at most so many times the parts of the one before, because what compiles or waits
// for memory at its first use says little about the next.
constexpr std::uint32_t max_growth = 8;

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

void FrameRun::start(std::vector<FrameStep> steps) {
  stop();
  steps_ = std::move(steps);
  step_ = 0;
  part_ = 0;
  timings_.clear();
  busy_s_ = 0;
}

void FrameRun::stop() {
  wait(std::numeric_limits<double>::infinity());
  steps_.clear();
  step_ = 0;
}

double FrameRun::cost_of(const FrameStep& step) const {
  const auto known = cost_s_.find(step.name);
  return known == cost_s_.end() ? 0 : known->second;
}

std::uint32_t FrameRun::parts_within(const FrameStep& step, double seconds) const {
  const auto last = last_run_.find(step.name);
  if (last == last_run_.end()) return std::max(1u, step.parts / first_share);
  const double fitting = seconds / std::max(cost_of(step), 1e-9);
  return std::max(
      1u, static_cast<std::uint32_t>(std::min(fitting, double(max_growth) * double(last->second))));
}

void FrameRun::record_parts(VkCommandBuffer commands, double slice_s) {
  const bool cut = std::isfinite(slice_s);
  double planned_s = 0;
  while (step_ < steps_.size()) {
    const FrameStep& step = steps_[step_];
    std::uint32_t count = step.parts - part_;
    if (cut) {
      const double cost_s = cost_of(step);
      const bool known = cost_s > 0;
      if (!submitted_.empty() && (!known || planned_s + cost_s > slice_s)) return;
      count = std::min(count, parts_within(step, slice_s - planned_s));
      planned_s += known ? cost_s * count : slice_s;
    } else if (submitted_.size() >= max_steps) {
      return;
    }
    step.record(commands, part_, count);
    submitted_.push_back({step_, count});
    part_ += count;
    if (part_ == step.parts) {
      gpu::full_barrier(commands);
      ++step_;
      part_ = 0;
    }
    timer_.mark(commands, step.name.c_str());
    if (cut && planned_s >= slice_s) return;
  }
}

void FrameRun::submit(double slice_s) {
  if (step_ == steps_.size()) return;
  VkCommandBuffer commands = submission_.begin();
  timer_.start(commands);
  submitted_.clear();
  record_parts(commands, slice_s);
  submitted_at_ = now_s();
  submission_.submit();
}

bool FrameRun::wait(double wait_s) {
  if (!submission_.is_running()) return true;
  if (!submission_.wait(wait_s)) return false;
  learn(now_s() - submitted_at_);
  return true;
}

void FrameRun::learn(double elapsed_s) {
  busy_s_ += elapsed_s;
  const std::vector<gpu::Timer::Span> spans = timer_.collect();
  const bool timed = spans.size() == submitted_.size();
  for (std::size_t i = 0; i < submitted_.size(); ++i) {
    const FrameStep& step = steps_[submitted_[i].step];
    // Without timestamps, the parts of a submission share its time evenly.
    const double seconds = timed ? spans[i].ms / 1000 : elapsed_s / double(submitted_.size());
    cost_s_[step.name] = std::max(seconds, 1e-9) / submitted_[i].count;
    last_run_[step.name] = submitted_[i].count;
  }
  for (const gpu::Timer::Span& span : spans) {
    if (!timings_.empty() && timings_.back().name == span.name)  // a part of the same step
      timings_.back().ms += span.ms;
    else
      timings_.push_back(span);
  }
}

double FrameRun::share_done() const {
  double all = 0, done = 0;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const double cost = std::max(cost_of(steps_[i]), 1e-9);
    all += cost * steps_[i].parts;
    done += cost * (i < step_ ? steps_[i].parts : i == step_ ? part_ : 0);
  }
  return all > 0 ? done / all : 0;
}

}  // namespace nightcity::render
