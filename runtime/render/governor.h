// Chooses how much work a frame does, so that frames keep to a budget of milliseconds: a pure
// controller, without a clock or a device of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/render/renderer.h"

namespace nightcity::render {

/// A setting that the governor may choose: bounds of a frame's samples. They change neither the
/// expected picture nor the history, so a change of rung is not seen but as more or less noise.
struct Rung {
  Effort effort;
  double ms = 0;              // of a frame, measured before the first is governed
  double relative_error = 0;  // of a frame: relative RMSE of its noise; 0 = not known

  /// Returns its name in logs: "8 candidates, 1 neighbours".
  std::string name() const;
};

/// Returns the efforts that lead from one candidate and no neighbour to what the settings ask for,
/// cheapest first, each at most about one and a half times as dear as the one before.
std::vector<Rung> list_rungs(const RenderSettings& settings);

struct GovernorOptions {
  double budget_ms = 0;  // of a frame; 0 = none
  // The governor takes no dearer rung than the cheapest whose frames keep this error. 0 = none.
  double target_error = 0;
  // A rung is taken only where a frame is expected to last this share of the budget: the rest is
  // for frames that differ from those before.
  double fill = 0.85;
  std::uint32_t patience = 30;  // frames without reason against a dearer rung before it is taken
};

class Governor {
 public:
  /// A change of the rung, and why.
  struct Decision {
    std::size_t frame;     // that is the first with the new rung
    std::size_t from, to;  // rungs
    double expected_ms;    // of a frame with the new rung
    std::string reason;
  };

  /// `rungs`, rising in cost, have measured times (or errors, where a target is set). Starts with
  /// the dearest rung that is expected to keep the budget and that the target needs. Throws
  /// UsageError where there is no rung, or neither budget nor target.
  Governor(std::vector<Rung> rungs, const GovernorOptions& options);

  /// Returns the rung of the next frame.
  std::size_t rung() const { return rung_; }
  const Effort& effort() const { return rungs_[rung_].effort; }
  const std::vector<Rung>& rungs() const { return rungs_; }
  /// Returns the dearest rung that is ever taken: the cheapest that keeps the target.
  std::size_t top() const { return top_; }
  /// Returns whether the target is kept by a rung, or there is none.
  bool can_keep_target() const { return can_keep_target_; }

  /// Takes the time of the frame that was rendered with rung(), and chooses the next frame's. A
  /// frame above the budget leads at once to the dearest rung that is expected to keep it; a dearer
  /// one is taken after `patience` frames that all left room for it, one rung at a time. A rung
  /// that had to be left again soon needs twice the patience the next time (at most 16 times), so
  /// that the picture does not flicker between two. A time that is not finite and positive is
  /// ignored.
  void observe(double ms);

  const std::vector<Decision>& decisions() const { return decisions_; }
  std::size_t frames() const { return frames_; }

 private:
  double expected_ms(std::size_t rung) const { return rungs_[rung].ms * load_; }
  std::size_t find_affordable(std::size_t at_most) const;
  void change_to(std::size_t rung, const std::string& reason);

  std::vector<Rung> rungs_;
  GovernorOptions options_;
  std::size_t rung_ = 0, top_ = 0;
  bool can_keep_target_ = true;
  // Times of the view against those that were measured for the rungs, as lately seen: rises at
  // once, falls slowly.
  double load_ = 1;
  std::uint32_t room_ = 0;     // frames in a row that left room for the next rung
  std::uint32_t backing_ = 1;  // times the patience
  std::size_t last_rise_ = 0;  // frame
  bool has_risen_ = false;
  std::size_t frames_ = 0;
  std::vector<Decision> decisions_;
};

}  // namespace nightcity::render
