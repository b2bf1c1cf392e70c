// Keeps the frames of the window to a budget while the view moves: chooses their size, measures the
// governor's rungs in slices, and tells it the times.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>

#include "runtime/render/governor.h"
#include "runtime/render/rung_meter.h"

namespace nightcity::viewer {

/// The rungs are those of such frames.
struct PaceOf {
  render::GovernorOptions options;
  render::RenderSettings settings;
  glm::uvec2 window{1, 1};    // pixels
  std::uint32_t divisor = 0;  // of its sides; 0 = the finest with which the budget can be kept
  scene::CameraPose pose;     // where rungs are measured
};

class Pace {
 public:
  /// Device, passes and scene must outlive the object.
  Pace(gpu::Device& device, render::PassLibrary& passes, render::DeviceScene& scene)
      : device_(device), passes_(passes), scene_(scene) {}

  /// Says what is shown. Where settings, window, divisor or options differ from those before, the
  /// rungs are to be measured anew; another pose or time does not matter.
  void set(const PaceOf& shown);
  /// Returns whether rungs are still to be measured: frames are not governed yet.
  bool is_measuring() const { return meter_ != nullptr; }
  /// Works at measuring them, for about `slice_s`, and waits at most `wait_s` for the device.
  void measure(double slice_s, double wait_s);
  /// Returns whether frames of this are governed as they are to be, if at all.
  bool is_settled(const PaceOf& shown) const;
  bool is_busy() const { return meter_ && meter_->is_busy(); }
  bool wait(double wait_s) { return !meter_ || meter_->wait(wait_s); }
  /// Waits for what runs on the device.
  void stop();

  /// Returns whether the next frame of a moving view is governed.
  bool governs() const { return governor_.has_value(); }
  /// The effort of that frame, and its divisor.
  const render::Effort& effort() const { return governor_->effort(); }
  std::uint32_t divisor() const { return divisor_; }
  /// Takes the milliseconds of the frame that was rendered so. Logs what is decided.
  void observe(double ms);

  /// Returns "16 ms: 8 candidates, 1 neighbours; 99.2 % of 340 frames within", or how far the
  /// measuring is; "" without a budget.
  std::string describe() const;

 private:
  void start_meter(std::uint32_t divisor, bool cheapest_alone);
  void end_meter();

  gpu::Device& device_;
  render::PassLibrary& passes_;
  render::DeviceScene& scene_;
  std::optional<PaceOf> shown_;
  std::unique_ptr<render::RungMeter> meter_;
  bool seeks_size_ = false;  // the meter measures the cheapest rung alone
  std::uint32_t divisor_ = 1;
  std::optional<render::Governor> governor_;
  std::size_t frames_ = 0, within_ = 0;
};

}  // namespace nightcity::viewer
