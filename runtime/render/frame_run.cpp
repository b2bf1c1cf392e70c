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

void FrameRun::record_parts(VkCommandBuffer commands, double slice_s) {
  const bool cut = std::isfinite(slice_s);
  double planned_s = 0;
  while (step_ < steps_.size()) {
    const FrameStep& step = steps_[step_];
    std::uint32_t count = step.parts - part_;
    if (cut) {
      const double part_s = costs_.of_part(step.name);
      const bool known = part_s > 0;
      if (!submitted_.empty() && (!known || planned_s + part_s > slice_s)) return;
      count = std::min(count, costs_.parts_within(step.name, step.parts, slice_s - planned_s));
      planned_s += known ? costs_.expect(step.name, count) : slice_s;
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
  if (timed && submitted_.size() == 1 && is_cpu_) spans[0].ms = 1000 * elapsed_s;
  for (std::size_t i = 0; i < submitted_.size(); ++i) {
    const FrameStep& step = steps_[submitted_[i].step];
    // Without timestamps, the parts of a submission share its time evenly.
    const double seconds = timed ? spans[i].ms / 1000 : elapsed_s / double(submitted_.size());
    costs_.learn(step.name, submitted_[i].count, seconds);
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
    const double cost = std::max(costs_.of_part(steps_[i].name), 1e-9);
    all += cost * steps_[i].parts;
    done += cost * (i < step_ ? steps_[i].parts : i == step_ ? part_ : 0);
  }
  return all > 0 ? done / all : 0;
}

}  // namespace nightcity::render
