// A hash grid of places in the plane, to find those near a point.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <unordered_map>
#include <vector>

namespace nightcity::place {

class PlaceGrid {
 public:
  /// A search visits (2 radius / cell_m + 2)^2 cells.
  explicit PlaceGrid(double cell_m) : cell_m_(cell_m) {}

  /// Adds a place, which must be finite.
  void add(const glm::dvec2& place, std::uint32_t number) {
    cells_[key(cell(place.x), cell(place.y))].push_back({place, number});
  }

  /// Calls visit(place, number) for every place within `radius`: cells from west to east, the
  /// places of a cell in the order in which they were added. Stops and returns true as soon as
  /// visit returns true.
  template <class Visit>
  bool any_near(const glm::dvec2& p, double radius, const Visit& visit) const {
    for (std::int64_t x = cell(p.x - radius); x <= cell(p.x + radius); ++x)
      for (std::int64_t y = cell(p.y - radius); y <= cell(p.y + radius); ++y) {
        const auto found = cells_.find(key(x, y));
        if (found == cells_.end()) continue;
        for (const Entry& entry : found->second)
          if (glm::distance(entry.place, p) <= radius && visit(entry.place, entry.number))
            return true;
      }
    return false;
  }

 private:
  struct Entry {
    glm::dvec2 place;
    std::uint32_t number;
  };
  std::int64_t cell(double v) const { return static_cast<std::int64_t>(std::floor(v / cell_m_)); }
  static std::uint64_t key(std::int64_t x, std::int64_t y) {
    return static_cast<std::uint64_t>(x) << 32 ^ (static_cast<std::uint64_t>(y) & 0xFFFFFFFFu);
  }

  double cell_m_;
  std::unordered_map<std::uint64_t, std::vector<Entry>> cells_;
};

}  // namespace nightcity::place
