#include "tools/inventory/add_to_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <unordered_map>
#include <utility>

#include "tools/place/longitude.h"

namespace nightcity::inventory {
namespace {

// Answers whether a lamp stands within a distance of a place, in cells of that size in degrees.
class Nearby {
 public:
  Nearby(const std::vector<osm::OsmLampNode>& lamps, double within_m)
      : lamps_(lamps), within_m_(within_m) {
    double farthest = 0;  // from the equator
    for (const osm::OsmLampNode& lamp : lamps)
      farthest = std::max(farthest, std::abs(lamp.lon_lat.y));
    scale_ = std::max(0.01, std::cos(farthest * std::numbers::pi / 180));
    for (std::size_t i = 0; i < lamps.size(); ++i) {
      const glm::dvec2 p = to_metres(lamps[i].lon_lat);
      cells_.emplace(key(cell(p.x), cell(p.y)), i);
    }
  }

  bool has(const glm::dvec2& lon_lat) const {
    if (!(within_m_ > 0)) return false;
    const glm::dvec2 p = to_metres(lon_lat);
    for (std::int64_t x = cell(p.x) - 1; x <= cell(p.x) + 1; ++x)
      for (std::int64_t y = cell(p.y) - 1; y <= cell(p.y) + 1; ++y) {
        const auto [first, last] = cells_.equal_range(key(x, y));
        for (auto at = first; at != last; ++at)
          if (glm::length(shorten(lon_lat, lamps_[at->second].lon_lat)) <= within_m_) return true;
      }
    return false;
  }

 private:
  static constexpr double metres_a_degree = 6'371'008.8 * std::numbers::pi / 180;  // mean radius

  // No degree along a parallel is taken longer than it is, so that near places share a cell or have
  // neighbouring ones.
  glm::dvec2 to_metres(const glm::dvec2& lon_lat) const {
    const double east =
        lamps_.empty() ? lon_lat.x : place::count_on(lon_lat.x, lamps_[0].lon_lat.x);
    return glm::dvec2(east * scale_, lon_lat.y) * metres_a_degree;
  }

  static glm::dvec2 shorten(const glm::dvec2& a, const glm::dvec2& b) {
    const double scale = std::cos(a.y * std::numbers::pi / 180);
    return glm::dvec2((place::count_on(b.x, a.x) - a.x) * scale, b.y - a.y) * metres_a_degree;
  }

  std::int64_t cell(double metres) const {
    return static_cast<std::int64_t>(std::floor(metres / std::max(within_m_, 0.01)));
  }
  static std::uint64_t key(std::int64_t x, std::int64_t y) {
    return static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ull ^ static_cast<std::uint64_t>(y);
  }

  const std::vector<osm::OsmLampNode>& lamps_;
  double within_m_, scale_ = 1;
  std::unordered_multimap<std::uint64_t, std::size_t> cells_;
};

}  // namespace

std::vector<InventoryReport> add_to_map(const std::vector<InventoryFile>& files,
                                        osm::OsmData& map) {
  std::vector<InventoryReport> reports;
  // From the last to the first, so that an earlier file's lamps replace a later one's.
  for (auto file = files.rbegin(); file != files.rend(); ++file) {
    Inventory inventory = read_inventory(*file);
    const Nearby nearby(inventory.lamps, file->within_m);
    inventory.report.replaced = std::erase_if(
        map.lamps, [&](const osm::OsmLampNode& lamp) { return nearby.has(lamp.lon_lat); });
    reports.insert(reports.begin(), std::move(inventory.report));
    map.lamps.insert(map.lamps.begin(), std::make_move_iterator(inventory.lamps.begin()),
                     std::make_move_iterator(inventory.lamps.end()));
  }
  return reports;
}

}  // namespace nightcity::inventory
