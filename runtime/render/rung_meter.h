// Measures the rungs of a governor on a device and a scene, in slices, so that a window stays alive
// meanwhile.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "runtime/measure/image.h"
#include "runtime/render/governor.h"
#include "runtime/scene/camera.h"

namespace nightcity::render {

/// The view and the time that a frame shows.
struct Moment {
  scene::CameraPose pose;
  double time_s;  // of the clock, since noon
};

/// The frames that are rendered in each place for a rung.
constexpr std::uint32_t rung_frames = 11;

/// Returns the moments of `rung_frames` frames at rest.
std::vector<Moment> at_rest(const scene::CameraPose& pose, double time_s);
/// Returns those of a camera that moves to its right by `step_m` a frame.
std::vector<Moment> moving_aside(const scene::CameraPose& pose, double time_s, double step_m);

class RungMeter {
 public:
  /// A place is some moments, at least six, one after the other: a camera that moves brings into
  /// view what has no history, and its frames take longer than those of a camera at rest. A rung's
  /// time is that of the slowest frame but one, in the slowest place; the first four frames of a
  /// place do not count. With `errors`, the noise of a frame is measured, too (the greatest).
  /// `rungs`, rising in cost, are those of list_rungs or some of them.
  RungMeter(std::unique_ptr<Renderer> renderer, std::vector<std::vector<Moment>> places,
            const RenderSettings& settings, std::vector<Rung> rungs, bool errors);

  /// Submits about `slice_s` of work and waits for it at most `wait_s`. Returns whether all rungs
  /// are measured.
  bool work(double slice_s, double wait_s);
  /// Returns whether a slice runs on the device.
  bool is_busy() const { return renderer_->is_busy(); }
  /// Waits at most `wait_s` for it, and returns whether none runs.
  bool wait(double wait_s) { return renderer_->wait(wait_s); }
  /// Waits for the slice that runs, and gives up its frame.
  void stop() { renderer_->abandon_frame(); }

  bool is_done() const { return rung_ == rungs_.size(); }
  std::size_t measured() const { return rung_; }
  std::size_t count() const { return rungs_.size(); }
  /// Returns the rungs in rising order of time, once all are measured.
  std::vector<Rung> take();

 private:
  void complete_frame();
  void complete_place();

  std::unique_ptr<Renderer> renderer_;
  std::vector<std::vector<Moment>> places_;
  RenderSettings settings_;
  bool errors_;
  std::vector<Rung> rungs_;
  std::size_t rung_ = 0, place_ = 0, frame_ = 0;
  std::uint32_t seed_ = 0;
  std::vector<double> ms_;
  std::vector<measure::Image> pictures_;
};

}  // namespace nightcity::render
