#include "runtime/render/governor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "formats/error.h"

namespace nightcity::render {
namespace {

// One frame in 100 may be above the budget; a fifth of that is kept back for rises that fail.
constexpr double paid_per_frame = 0.008;
constexpr double min_account = -4;  // so that a lowest rung that is too dear is soon forgiven
constexpr double account_to_rise = 0.5;
constexpr std::size_t window = 120;  // frames that a dearer rung must suit
constexpr std::size_t recent = 16;   // frames that show where the times are heading
constexpr double near_budget = 0.95;
constexpr std::uint32_t max_backing = 16;

}  // namespace

std::string Rung::name() const {
  std::string text = std::to_string(effort.max_candidates) + " candidates, " +
                     std::to_string(effort.max_neighbours) + " neighbours";
  if (effort.resolution_scale < 1)
    text += ", " + std::to_string(std::lround(100 * effort.resolution_scale)) + " % of each side";
  if (effort.max_cell_paths < std::numeric_limits<std::uint32_t>::max())
    text += ", " + std::to_string(effort.max_cell_paths) + " paths a cell";
  if (effort.half_rate) text += ", every second pixel";
  return text;
}

namespace {

// Bounds the paths of the irradiance cache's cells, and adds the rung that does not.
void bound_cell_paths(const RenderSettings& settings, std::vector<Rung>& rungs) {
  if (find_indirect(settings) != INDIRECT_CACHE) return;
  const Rung whole = rungs.back();
  for (Rung& rung : rungs) rung.effort.max_cell_paths = settings.indirect.paths;
  rungs.front().effort.max_cell_paths = 1;
  rungs.push_back(whole);
}

}  // namespace

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
    if (c >= candidates && n >= neighbours) break;
    if (n < neighbours && (c >= candidates || c >= 8 * (n + 1) || (n == 0 && c >= 4)))
      ++n;
    else
      c *= 2;
  }
  bound_cell_paths(settings, rungs);
  // If one candidate a pixel is too many, frames that sample fewer pixels remain: first half of
  // them, with all edges in place, then smaller ones.
  const Rung every_pixel = rungs.front();
  const auto add_cheaper = [&](const Effort& effort) {
    Rung cheaper = every_pixel;
    cheaper.effort.half_rate = effort.half_rate;
    cheaper.effort.resolution_scale = effort.resolution_scale;
    rungs.insert(rungs.begin(), cheaper);
  };
  if (!traits.samples) return rungs;
  if (!settings.sampling.half_rate && !settings.sampling.layers) add_cheaper({.half_rate = true});
  for (const float scale : {0.71f, 0.5f}) add_cheaper({.resolution_scale = scale});
  return rungs;
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
  rung_ = options.budget_ms > 0 ? find_affordable(top_, 1, options.fill * options.budget_ms) : top_;
}

// Returns the dearest rung up to `at_most` that is expected to last no longer than the limit under
// a load, or the cheapest where none is.
std::size_t Governor::find_affordable(std::size_t at_most, double load, double limit_ms) const {
  for (std::size_t rung = at_most; rung > 0; --rung)
    if (rungs_[rung].ms * load <= limit_ms) return rung;
  return 0;
}

// Returns the load of the frame that is `rank`-th (from 0) among the slowest of the last `frames`.
double Governor::find_load(std::size_t frames, std::size_t rank) const {
  std::vector<double> last(loads_.end() - std::ptrdiff_t(std::min(frames, loads_.size())),
                           loads_.end());
  const auto at = last.begin() + std::ptrdiff_t(std::min(rank, last.size() - 1));
  std::nth_element(last.begin(), at, last.end(), std::greater<>());
  return *at;
}

void Governor::change_to(std::size_t rung, double load, const std::string& reason) {
  decisions_.push_back({frames_, rung_, rung, rungs_[rung].ms * load, reason});
  rung_ = rung;
  last_change_ = frames_;
}

void Governor::fall(std::size_t rung, double load, const std::string& reason) {
  if (rung >= rung_) return;
  // A rise that did not last: the next one takes longer.
  if (has_risen_ && frames_ - last_rise_ <= std::size_t{options_.patience} * backing_ * 8)
    backing_ = std::min(2 * backing_, max_backing);
  has_risen_ = false;
  change_to(rung, load, reason);
}

void Governor::rise_where_there_is_room() {
  if (rung_ >= top_ || account_ < account_to_rise) return;
  if (frames_ - last_change_ < std::size_t{options_.patience} * backing_) return;
  const double load = find_load(window, 1);
  if (rungs_[rung_ + 1].ms * load > options_.fill * options_.budget_ms) return;
  if (has_risen_ && frames_ - last_rise_ > std::size_t{options_.patience} * backing_ * 8)
    backing_ = std::max(1u, backing_ / 2);  // the last rise has lasted
  change_to(rung_ + 1, load, "there was room for it");
  last_rise_ = frames_;
  has_risen_ = true;
}

void Governor::observe(double ms) {
  ++frames_;
  if (!(options_.budget_ms > 0) || !std::isfinite(ms) || !(ms > 0)) return;
  if (frames_ <= options_.lead_frames) return;
  loads_.push_back(rungs_[rung_].ms > 0 ? ms / rungs_[rung_].ms : 1);
  if (loads_.size() > window) loads_.pop_front();
  account_ = std::min(1.0, account_ + paid_per_frame);
  if (ms > options_.budget_ms) {
    account_ = std::max(min_account, account_ - 1);
    if (account_ >= 0 || rung_ == 0) return;
    const double load = find_load(2, 1);
    fall(std::min(rung_ - 1, find_affordable(rung_, load, near_budget * options_.budget_ms)), load,
         "too many frames were above the budget");
    return;
  }
  if (rung_ > 0 && frames_ - last_change_ >= recent && loads_.size() >= recent) {
    const double load = find_load(recent, 2);
    if (rungs_[rung_].ms * load > near_budget * options_.budget_ms) {
      fall(rung_ - 1, load, "frames came close to the budget");
      return;
    }
  }
  rise_where_there_is_room();
}

std::string describe(const Governor& governor, const Governor::Decision& decision) {
  return fmt::format("frame {}: {} instead of {}, {:.3g} ms expected: {}", decision.frame,
                     governor.rungs()[decision.to].name(), governor.rungs()[decision.from].name(),
                     decision.expected_ms, decision.reason);
}

std::string describe_start(const Governor& governor, const GovernorOptions& options) {
  std::string text;
  for (const Rung& rung : governor.rungs()) {
    text += fmt::format("{}{}: {:.3g} ms", text.empty() ? "" : "; ", rung.name(), rung.ms);
    if (rung.relative_error > 0 && std::isfinite(rung.relative_error))
      text += fmt::format(", noise {:.3g}", rung.relative_error);
  }
  text = "measured " + text + ". Starts with " + governor.rungs()[governor.rung()].name();
  if (!governor.can_keep_target())
    text += fmt::format(": none keeps a noise of {:g}", options.target_error);
  if (options.budget_ms > 0 && governor.rungs().front().ms > options.budget_ms)
    text += fmt::format(": none keeps {:g} ms", options.budget_ms);
  return text;
}

}  // namespace nightcity::render
