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
// A slice holds at most so many times the parts of the one before: a few cheap ones say little of
// the next.
constexpr std::uint32_t max_growth = 8;
// Parts of a step differ: sky costs little, a square full of lamps much. The dearest so far counts,
// and is forgotten by this factor a slice. Most slices are then shorter than asked for, and hardly
// one longer by more than half.
constexpr double peak_kept = 0.98, beyond_slice = 1.5;

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
  const double cost_s = cost_of(step);
  if (cost_s <= 0) return std::min(last->second, step.parts);
  const double fitting = beyond_slice * seconds / cost_s;
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
      planned_s += known ? cost_s * count / beyond_slice : slice_s;
    } else if (submitted_.size() >= max_steps) {
      return;
    }
    step.record(commands, part_, count);
    submitted_.push_back({step_, count});
    part_ += count;
    const bool whole = part_ == step.parts;
    if (whole) {
      gpu::full_barrier(commands);
      ++step_;
      part_ = 0;
    }
    timer_.mark(commands, step.name.c_str());
    // The rest of a step waits for what this part says of its cost.
    if (cut && (!whole || planned_s >= slice_s)) return;
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
  std::vector<gpu::Timer::Span> spans = timer_.collect();
  const bool timed = spans.size() == submitted_.size();
  // Mesa's CPU driver may take the first time stamp after the first part has run (seen with a
  // window), so the host's clock decides where there is one part alone.
  if (timed && submitted_.size() == 1) spans[0].ms = 1000 * elapsed_s;
  for (std::size_t i = 0; i < submitted_.size(); ++i) {
    const FrameStep& step = steps_[submitted_[i].step];
    // Without timestamps, the parts of a submission share its time evenly.
    const double seconds = timed ? spans[i].ms / 1000 : elapsed_s / double(submitted_.size());
    const double cost_s = std::max(seconds, 1e-9) / submitted_[i].count;
    // The first run of a step compiles on some devices, and says nothing.
    if (last_run_.count(step.name) != 0)
      cost_s_[step.name] = std::max(cost_s, peak_kept * cost_of(step));
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
