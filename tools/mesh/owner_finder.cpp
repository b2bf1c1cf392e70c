#include "tools/mesh/owner_finder.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "formats/finite.h"

namespace nightcity::mesh {

bool holds(std::span<const std::vector<glm::dvec2>> rings, const glm::dvec2& place) {
  bool inside = false;
  for (const auto& ring : rings)
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const glm::dvec2 &a = ring[i], &b = ring[j];
      if ((a.y > place.y) != (b.y > place.y) &&
          place.x < (b.x - a.x) * (place.y - a.y) / (b.y - a.y) + a.x)
        inside = !inside;
    }
  return inside;
}

void OwnerFinder::Box::add(const glm::dvec2& p) {
  if (!finite(p)) return;
  low = glm::min(low, p);
  high = glm::max(high, p);
}

OwnerFinder::OwnerFinder(const PlaneLayer& layer) : layer_(layer), boxes_(layer.size()) {
  constexpr std::size_t max_side = 128;
  for (std::size_t i = 0; i < layer.size(); ++i) {
    for (const auto& ring : layer[i].rings)
      for (const glm::dvec2& p : ring) boxes_[i].add(p);
    if (boxes_[i].is_empty()) continue;
    whole_.add(boxes_[i].low);
    whole_.add(boxes_[i].high);
  }
  if (whole_.is_empty()) return;
  for (std::size_t side = 1; side == 1 || (side <= max_side && side * side <= 4 * layer.size());
       side *= 2)
    grids_.push_back({side});
  for (std::uint32_t i = 0; i < layer.size(); ++i)
    if (!boxes_[i].is_empty()) add(i, boxes_[i]);
}

void OwnerFinder::add(std::uint32_t area, const Box& box) {
  std::size_t level = grids_.size() - 1;
  const auto spans = [&](int axis) {
    const Grid& grid = grids_[level];
    return find_column(grid, box.high, axis) - find_column(grid, box.low, axis);
  };
  while (level > 0 && (spans(0) > 1 || spans(1) > 1)) --level;
  Grid& grid = grids_[level];
  if (grid.squares.empty()) grid.squares.resize(grid.side * grid.side);
  for (std::size_t row = find_column(grid, box.low, 1); row <= find_column(grid, box.high, 1);
       ++row)
    for (std::size_t column = find_column(grid, box.low, 0);
         column <= find_column(grid, box.high, 0); ++column)
      grid.squares[row * grid.side + column].push_back(area);
}

std::uint32_t OwnerFinder::find(const glm::dvec2& place) const {
  if (!whole_.holds(place)) return no_label;
  std::size_t first = layer_.size();
  for (const Grid& grid : grids_) {
    if (grid.squares.empty()) continue;
    for (const std::uint32_t i :
         grid.squares[find_column(grid, place, 1) * grid.side + find_column(grid, place, 0)]) {
      if (i >= first) break;
      if (!boxes_[i].holds(place) || !mesh::holds(layer_[i].rings, place)) continue;
      first = i;
      break;
    }
  }
  return first < layer_.size() ? layer_[first].label : no_label;
}

// Returns the column of a place along axis 0, its row along axis 1.
std::size_t OwnerFinder::find_column(const Grid& grid, const glm::dvec2& place, int axis) const {
  const double low = whole_.low[axis], high = whole_.high[axis];
  const double share = high > low ? (place[axis] - low) / (high - low) : 0;
  return std::min(static_cast<std::size_t>(share * static_cast<double>(grid.side)), grid.side - 1);
}

}  // namespace nightcity::mesh
