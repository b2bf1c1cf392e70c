// The steps of a frame, submitted to the device in parts, so that a program can look at its input
// between two of them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "runtime/gpu/submission.h"
#include "runtime/gpu/timer.h"
#include "runtime/render/step_costs.h"

namespace nightcity::render {

/// A step of a frame. Every step ends with a barrier, which the run records.
struct FrameStep {
  std::string name;         // the timer's
  std::uint32_t parts = 1;  // into which it can be cut: work groups
  std::function<void(VkCommandBuffer, std::uint32_t first, std::uint32_t count)> record;
};

/// Runs the steps of a frame in order. One submission runs at a time.
class FrameRun {
 public:
  /// The device must outlive the object.
  explicit FrameRun(gpu::Device& device)
      : timer_(device), submission_(device), is_cpu_(device.info().kind == "cpu") {}

  /// Begins the steps of a frame. Nothing is submitted yet.
  void start(std::vector<FrameStep> steps);
  /// Drops the steps that have not been submitted, after waiting for those that have.
  void stop();

  /// Submits the next parts, as many as ran within `slice_s` by the times of earlier frames; a step
  /// that has not run yet begins with a small part. With an infinite slice, as many whole steps as
  /// hide the cost of submitting. Call it only while nothing is submitted.
  void submit(double slice_s);
  /// Waits at most `wait_s`. Returns whether nothing is submitted.
  bool wait(double wait_s);

  bool is_submitted() const { return submission_.is_running(); }
  /// Returns whether every step has run.
  bool is_done() const { return step_ == steps_.size() && !submission_.is_running(); }
  /// Returns the share of the frame's time that has passed, 0 .. 1, by the times of earlier frames.
  double share_done() const;
  /// Returns the GPU milliseconds of the steps that have run, by name; empty where the queue has no
  /// timestamps.
  const std::vector<gpu::Timer::Span>& timings() const { return timings_; }
  /// Returns the seconds during which the device worked at the steps, as the host saw it.
  double busy_s() const { return busy_s_; }

 private:
  struct Part {
    std::size_t step;
    std::uint32_t count;
  };
  void record_parts(VkCommandBuffer commands, double slice_s);
  void learn(double elapsed_s);

  gpu::Timer timer_;
  gpu::Submission submission_;
  const bool is_cpu_;
  std::vector<FrameStep> steps_;
  std::size_t step_ = 0;    // the next to be submitted,
  std::uint32_t part_ = 0;  // from this part on
  std::vector<Part> submitted_;
  double submitted_at_ = 0;
  StepCosts costs_;
  std::vector<gpu::Timer::Span> timings_;
  double busy_s_ = 0;
};

}  // namespace nightcity::render
