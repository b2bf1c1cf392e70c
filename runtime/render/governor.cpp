#include "runtime/render/governor.h"

#include <algorithm>
#include <cmath>

#include "formats/error.h"

namespace nightcity::render {
namespace {

// The load falls by this share of the difference in each frame: in half a second at 60 frames.
constexpr double forgetting = 0.05;
constexpr std::uint32_t max_backing = 16;

}  // namespace

std::string Rung::name() const {
  return std::to_string(effort.max_candidates) + " candidates, " +
         std::to_string(effort.max_neighbours) + " neighbours";
}

std::vector<Rung> list_rungs(const RenderSettings& settings) {
  const EstimatorTraits& traits = traits_of(settings.sampling.estimator);
  const std::uint32_t candidates = traits.samples ? settings.sampling.candidates : 1,
                      neighbours = traits.reuses ? settings.reuse.neighbours : 0;
  // A neighbour costs about as much as eight candidates (docs/measurements): both grow together.
  std::vector<Rung> rungs;
  std::uint32_t c = 1, n = 0;
  while (true) {
    Rung rung;
    rung.effort = {std::min(c, candidates), std::min(n, neighbours)};
    if (rungs.empty() || rung.effort != rungs.back().effort) rungs.push_back(rung);
    if (c >= candidates && n >= neighbours) return rungs;
    if (n < neighbours && (c >= candidates || c >= 8 * (n + 1) || (n == 0 && c >= 4)))
      ++n;
    else
      c *= 2;
  }
}

Governor::Governor(std::vector<Rung> rungs, const GovernorOptions& options)
    : rungs_(std::move(rungs)), options_(options) {
  if (rungs_.empty()) throw UsageError("--budget-ms", "there is no setting to choose from");
  if (!(options.budget_ms > 0) && !(options.target_error > 0))
    throw UsageError("--budget-ms", "or --target-error must be above 0");
  top_ = rungs_.size() - 1;
  if (options.target_error > 0) {
    const auto keeps = std::find_if(rungs_.begin(), rungs_.end(), [&](const Rung& rung) {
      return rung.relative_error <= options.target_error;
    });
    can_keep_target_ = keeps != rungs_.end();
    if (can_keep_target_) top_ = static_cast<std::size_t>(keeps - rungs_.begin());
  }
  rung_ = find_affordable(top_);
}

// Returns the dearest rung up to `at_most` that is expected to fill the budget's share at most, or
// the cheapest where none is.
std::size_t Governor::find_affordable(std::size_t at_most) const {
  if (!(options_.budget_ms > 0)) return at_most;
  for (std::size_t rung = at_most; rung > 0; --rung)
    if (expected_ms(rung) <= options_.fill * options_.budget_ms) return rung;
  return 0;
}

void Governor::change_to(std::size_t rung, const std::string& reason) {
  if (rung == rung_) return;
  decisions_.push_back({frames_, rung_, rung, expected_ms(rung), reason});
  rung_ = rung;
  room_ = 0;
}

void Governor::observe(double ms) {
  ++frames_;
  if (!(options_.budget_ms > 0) || !std::isfinite(ms) || !(ms > 0)) return;
  const double seen = rungs_[rung_].ms > 0 ? ms / rungs_[rung_].ms : load_;
  load_ = seen > load_ ? seen : load_ + forgetting * (seen - load_);
  if (ms > options_.budget_ms) {
    // A rise that did not last: the next one takes longer.
    if (has_risen_ && frames_ - last_rise_ <= std::size_t{options_.patience} * backing_ * 2)
      backing_ = std::min(2 * backing_, max_backing);
    room_ = 0;
    change_to(find_affordable(rung_), "a frame was above the budget");
    return;
  }
  const bool has_room =
      rung_ < top_ && expected_ms(rung_ + 1) <= options_.fill * options_.budget_ms;
  room_ = has_room ? room_ + 1 : 0;
  if (room_ < options_.patience * backing_) return;
  if (has_risen_ && frames_ - last_rise_ > std::size_t{options_.patience} * backing_ * 8)
    backing_ = 1;  // the last rise has lasted
  change_to(rung_ + 1, "there was room for it");
  last_rise_ = frames_;
  has_risen_ = true;
}

}  // namespace nightcity::render
