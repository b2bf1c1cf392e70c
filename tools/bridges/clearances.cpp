#include "tools/bridges/clearances.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tools/ground_cover/measured_line.h"
#include "tools/line.h"

namespace nightcity::bridges {
namespace {

// Places below a deck are asked this far apart, along it and across.
constexpr double place_step_m = 1;
// A way that runs on below a deck beyond its crossing is followed so far.
constexpr double max_beyond_m = 100;

// Returns the part of a way within a distance of a place on one of its segments.
Line find_part(const PlacedWay& way, std::size_t segment, const glm::dvec2& place, double reach_m) {
  std::size_t first = segment, last = segment + 1;
  const auto length_from = [&](std::size_t i) {
    return glm::distance(way.line[i], way.line[i + 1]);
  };
  for (double m = glm::distance(place, way.line[first]); first > 0 && m < reach_m;)
    m += length_from(--first);
  for (double m = glm::distance(place, way.line[last]); last + 1 < way.line.size() && m < reach_m;)
    m += length_from(last++);
  return {way.line.begin() + static_cast<std::ptrdiff_t>(first),
          way.line.begin() + static_cast<std::ptrdiff_t>(last) + 1};
}

class ClearanceFinder {
 public:
  ClearanceFinder(const Chain& chain, const PlacedWay& way, const Crossing& crossing,
                  const CarriedKind& below, const SurfaceAt& surface_at)
      : chain_(chain),
        along_(chain.line),
        half_m_(way.half_m),
        below_(below),
        surface_at_(surface_at),
        part_(find_part(way, crossing.segment, crossing.place, crossing.half_m + max_beyond_m)) {}

  std::vector<Clearance> find(const Crossing& crossing) {
    const auto middle_m = surface_at_(crossing.place);
    if (!middle_m) return {};
    const double from = crossing.at_m - crossing.half_m, to = crossing.at_m + crossing.half_m;
    const double steps = std::ceil((to - from) / place_step_m);
    double at = from;
    std::optional<double> before = find_highest(at);
    const auto first = before;
    for (double k = 1; k <= steps; ++k) {
      const double next = k < steps ? from + (to - from) * (k / steps) : to;
      const auto highest = find_highest(next);
      add(at, next, std::max(before, highest).value_or(*middle_m), below_.least_clear_m);
      at = next;
      before = highest;
    }
    follow(from, first, -1);
    follow(to, before, 1);
    return std::move(found_);
  }

 private:
  void add(double from, double to, double surface_m, double least_clear_m) {
    found_.push_back(
        {from, to, surface_m + below_.clear_m + deck_m, surface_m + least_clear_m + deck_m});
  }

  // Follows the way from an end of its crossing as far as the deck covers it.
  void follow(double at, std::optional<double> before, double direction) {
    constexpr double nothing_less = -std::numeric_limits<double>::infinity();
    const double end = at + direction * max_beyond_m;
    while (before && (end - at) * direction > 0) {
      const double next = at + direction * place_step_m;
      const auto highest = find_highest(next);
      if (!highest) return;
      add(std::min(at, next), std::max(at, next), *std::max(before, highest), nothing_less);
      at = next;
      before = highest;
    }
  }

  // Returns the height of the highest place of the way that the deck covers at a distance from the
  // chain's start; none where it covers none.
  std::optional<double> find_highest(double s) const {
    std::optional<double> highest;
    if (s < 0 || s > along_.length_m()) return highest;
    const double steps = std::ceil(2 * chain_.half_m / place_step_m);
    for (double k = 0; k <= steps; ++k) {
      const glm::dvec2 place = along_.find_beside(s, chain_.half_m * (2 * k / steps - 1));
      if (!lies_on_way(place)) continue;
      if (const auto height = surface_at_(place))
        highest = std::max(highest.value_or(*height), *height);
    }
    return highest;
  }

  bool lies_on_way(const glm::dvec2& place) const {
    constexpr double slack_m = 1e-6;
    for (std::size_t i = 0; i + 1 < part_.size(); ++i)
      if (find_distance(place, part_[i], part_[i + 1]) <= half_m_ + slack_m) return true;
    return false;
  }

  const Chain& chain_;
  ground_cover::MeasuredLine along_;
  double half_m_;  // of the way
  const CarriedKind& below_;
  const SurfaceAt& surface_at_;
  Line part_;  // of the way
  std::vector<Clearance> found_;
};

}  // namespace

std::vector<Clearance> find_clearances(const Chain& chain, const PlacedWay& way,
                                       const Crossing& crossing, const CarriedKind& below,
                                       const SurfaceAt& surface_at) {
  return ClearanceFinder(chain, way, crossing, below, surface_at).find(crossing);
}

}  // namespace nightcity::bridges
