// Chooses how much work a frame does, so that 99 % of the frames keep to a budget of milliseconds:
// a pure controller, without a clock or a device of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
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

  /// Returns its name in logs: "8 candidates, 1 neighbours, 2 paths a cell".
  std::string name() const;
};

/// Returns the efforts that lead from one candidate and no neighbour to what the settings ask for,
/// cheapest first, each at most about one and a half times as dear as the one before. With an
/// irradiance cache, cells that come into view get no more paths than others but in the last rung:
/// while the camera moves, they are many, and a frame's time would depend on their number. The
/// cheapest have the samples of the first that samples every pixel: half of the pixels, then 71 and
/// 50 % of the picture's sides.
std::vector<Rung> list_rungs(const RenderSettings& settings);

struct GovernorOptions {
  double budget_ms = 0;  // of a frame; 0 = none
  // The governor takes no dearer rung than the cheapest whose frames keep this error. 0 = none.
  double target_error = 0;
  // A dearer rung is taken only where a frame is expected to last this share of the budget: the
  // rest is for frames that differ from those before.
  double fill = 0.85;
  std::uint32_t patience = 60;  // frames between a change and a dearer rung, at least
  // Frames at the start that are not judged: they fill reservoirs and irradiance cache, and take
  // longer than those after them.
  std::uint32_t lead_frames = 4;
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
  /// time that is not finite and positive is ignored, and so are those of the lead frames.
  ///
  /// Frames above the budget are paid for from an account: each frame adds 0.008 to it, up to 1,
  /// and each frame above the budget takes 1. Where it is overdrawn, that frame leads to a cheaper
  /// rung: the next one, or the one that the better of the last two frames asks for. So a single
  /// slow frame changes nothing, two in 125 do. A cheaper rung is also taken where three of the
  /// last 16 frames came within 5 % of the budget. The next dearer rung is taken where the account
  /// holds at least a half, `patience` frames have passed since the last change, and the second
  /// slowest of the last 120 frames would have left room for it. A rung that had to be left again
  /// needs twice the patience the next time (at most 16 times). There is therefore one rise in
  /// `patience` frames at most, and no more falls than rises and rungs.
  void observe(double ms);

  const std::vector<Decision>& decisions() const { return decisions_; }
  std::size_t frames() const { return frames_; }

 private:
  std::size_t find_affordable(std::size_t at_most, double load, double limit_ms) const;
  double find_load(std::size_t frames, std::size_t rank) const;
  void change_to(std::size_t rung, double load, const std::string& reason);
  void fall(std::size_t rung, double load, const std::string& reason);
  void rise_where_there_is_room();

  std::vector<Rung> rungs_;
  GovernorOptions options_;
  std::size_t rung_ = 0, top_ = 0;
  bool can_keep_target_ = true;
  // Times of the last frames against those that were measured for their rungs, the latest last.
  std::deque<double> loads_;
  double account_ = 1;
  std::size_t last_change_ = 0, last_rise_ = 0;  // frames
  std::uint32_t backing_ = 1;                    // times the patience
  bool has_risen_ = false;
  std::size_t frames_ = 0;
  std::vector<Decision> decisions_;
};

/// Returns the decision in words: frame, rungs, reason.
std::string describe(const Governor& governor, const Governor::Decision& decision);

/// Returns what the governor starts with, in words; with its rungs' times and errors.
std::string describe_start(const Governor& governor, const GovernorOptions& options);

}  // namespace nightcity::render
