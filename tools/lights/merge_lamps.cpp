#include "tools/lights/merge_lamps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "tools/line.h"

namespace nightcity::lights {
namespace {

constexpr double least_cosine = 0.5;  // between the aims of lamps of a kind

using Cell = std::pair<std::int64_t, std::int64_t>;

bool is_alike(const PlacedLamp& a, const PlacedLamp& b) {
  return a.profile == b.profile && a.colour == b.colour && a.hours == b.hours &&
         glm::dot(a.aim, b.aim) > least_cosine;
}

// Lamps by squares of the plan as wide as the distance.
class Neighbours {
 public:
  Neighbours(const std::vector<PlacedLamp>& lamps, double distance_m)
      : lamps_(lamps), distance_m_(distance_m) {
    for (std::size_t n = 0; n < lamps.size(); ++n) cells_[cell_of(lamps[n])].push_back(n);
  }

  template <class Visit>
  void visit(std::size_t lamp, const Visit& visit) const {
    const auto [column, row] = cell_of(lamps_[lamp]);
    for (std::int64_t x = column - 1; x <= column + 1; ++x)
      for (std::int64_t y = row - 1; y <= row + 1; ++y) {
        const auto found = cells_.find({x, y});
        if (found == cells_.end()) continue;
        for (const std::size_t other : found->second)
          if (glm::distance(glm::dvec2(lamps_[lamp].foot), glm::dvec2(lamps_[other].foot)) <=
              distance_m_)
            visit(other);
      }
  }

 private:
  Cell cell_of(const PlacedLamp& lamp) const {
    return {static_cast<std::int64_t>(std::floor(lamp.foot.x / distance_m_)),
            static_cast<std::int64_t>(std::floor(lamp.foot.y / distance_m_))};
  }

  const std::vector<PlacedLamp>& lamps_;
  double distance_m_;
  std::map<Cell, std::vector<std::size_t>> cells_;
};

}  // namespace

std::size_t merge_lamps(double distance_m, LampSet& set) {
  if (!(distance_m > 0)) return 0;
  std::vector<PlacedLamp>& lamps = set.lamps;
  const Neighbours neighbours(lamps, distance_m);
  std::vector<std::size_t> by_flux(lamps.size());
  std::iota(by_flux.begin(), by_flux.end(), std::size_t{0});
  std::stable_sort(by_flux.begin(), by_flux.end(), [&lamps](std::size_t a, std::size_t b) {
    if (lamps[a].flux_lm != lamps[b].flux_lm) return lamps[a].flux_lm > lamps[b].flux_lm;
    return comes_before(glm::dvec2(lamps[a].foot), glm::dvec2(lamps[b].foot));
  });
  std::vector<bool> is_settled(lamps.size()), is_gone(lamps.size());
  std::vector<double> flux(lamps.size());
  for (std::size_t n = 0; n < lamps.size(); ++n) flux[n] = lamps[n].flux_lm;
  for (const std::size_t strongest : by_flux) {
    if (is_settled[strongest]) continue;
    is_settled[strongest] = true;
    double squares = lamps[strongest].radius_m * lamps[strongest].radius_m;
    neighbours.visit(strongest, [&](std::size_t other) {
      if (is_settled[other] || !is_alike(lamps[strongest], lamps[other])) return;
      is_settled[other] = is_gone[other] = true;
      flux[strongest] += flux[other];
      squares += lamps[other].radius_m * lamps[other].radius_m;
    });
    lamps[strongest].radius_m = std::sqrt(squares);
  }
  std::size_t kept = 0;
  for (std::size_t n = 0; n < lamps.size(); ++n) {
    if (is_gone[n]) continue;
    lamps[n].flux_lm = flux[n];
    if (kept != n) lamps[kept] = std::move(lamps[n]);
    ++kept;
  }
  const std::size_t gone = lamps.size() - kept;
  lamps.resize(kept);
  return gone;
}

}  // namespace nightcity::lights
