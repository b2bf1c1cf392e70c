#include "tools/map_buildings/part_index.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "tools/in_ring.h"

namespace nightcity::map_buildings {
namespace {

constexpr double cell_degrees = 0.002;
constexpr int max_cells = 100;  // a side of a building: 20 km; what is larger is no building

struct Box {
  glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-low};
};

Box find_box(const osm::MapArea& area) {
  Box box;
  for (const osm::MapRings& rings : area.rings)
    for (const glm::dvec2& p : rings.outer) {
      box.low = glm::min(box.low, p);
      box.high = glm::max(box.high, p);
    }
  return box;
}

std::pair<int, int> find_cell(const glm::dvec2& p) {
  return {static_cast<int>(std::floor(p.x / cell_degrees)),
          static_cast<int>(std::floor(p.y / cell_degrees))};
}

}  // namespace

glm::dvec2 find_place_inside(const osm::MapArea& area) {
  const std::vector<glm::dvec2>& ring = area.rings.front().outer;
  glm::dvec2 mean{0};
  for (const glm::dvec2& p : ring) mean += (p - ring[0]) / static_cast<double>(ring.size());
  mean += ring[0];
  if (in_ring(ring, mean)) return mean;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 middle = (ring[i] + ring[(i + 2) % ring.size()]) / 2.0;
    if (in_ring(ring, middle)) return middle;
  }
  return ring[0];
}

PartIndex::PartIndex(const std::vector<osm::MapArea>& buildings) : buildings_(buildings) {
  for (std::size_t i = 0; i < buildings.size(); ++i) {
    const Box box = find_box(buildings[i]);
    const auto low = find_cell(box.low), high = find_cell(box.high);
    if (high.first - low.first > max_cells || high.second - low.second > max_cells) continue;
    for (int x = low.first; x <= high.first; ++x)
      for (int y = low.second; y <= high.second; ++y) cells_[{x, y}].push_back(i);
  }
}

std::optional<std::size_t> PartIndex::find_building(const osm::MapArea& part) const {
  const glm::dvec2 place = find_place_inside(part);
  const auto cell = cells_.find(find_cell(place));
  if (cell == cells_.end()) return {};
  std::optional<std::size_t> found;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : cell->second) {
    const Box box = find_box(buildings_[i]);
    const double size = (box.high.x - box.low.x) * (box.high.y - box.low.y);
    const auto holds = [&](const osm::MapRings& rings) { return in_ring(rings.outer, place); };
    if (size >= least ||
        !std::any_of(buildings_[i].rings.begin(), buildings_[i].rings.end(), holds))
      continue;
    least = size;
    found = i;
  }
  return found;
}

}  // namespace nightcity::map_buildings
