#include "tools/mesh/edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "tools/mesh/polygon_plane.h"

namespace nightcity::mesh {
namespace {

struct Corner {
  std::array<std::int64_t, 3> cell;  // of a millimetre
  std::uint32_t index;               // of the corner, in the order of the rings

  // Written out: comparing tuples takes twice as long.
  bool operator<(const Corner& other) const {
    for (std::size_t i = 0; i < cell.size(); ++i)
      if (cell[i] != other.cell[i]) return cell[i] < other.cell[i];
    return index < other.index;
  }
};

bool comes_before(const EdgeUse& a, const EdgeUse& b) {
  if (a.low != b.low) return a.low < b.low;
  if (a.high != b.high) return a.high < b.high;
  if (a.polygon != b.polygon) return a.polygon < b.polygon;
  return a.forward < b.forward;
}

}  // namespace

EdgeTable::EdgeTable(const city::CityObject& object) {
  number_vertices(object);
  index_uses(object.polygons.size());
  leave_out_inner_walls(object.polygons.size());
}

// Sorting is faster than hashing here: an object has dozens of vertices, and none of them
// allocates.
void EdgeTable::number_vertices(const city::CityObject& object) {
  std::size_t count = 0;
  for (const city::Polygon& polygon : object.polygons) count += city::count_vertices(polygon);
  std::vector<Corner> corners;
  std::vector<glm::dvec3> points;
  corners.reserve(count);
  points.reserve(count);
  uses_.reserve(count);
  const auto add = [&](const city::Ring& ring) {
    for (const glm::dvec3& p : ring) {
      constexpr double per_metre = 1 / one_place_m;
      corners.push_back({{std::llround(p.x * per_metre), std::llround(p.y * per_metre),
                          std::llround(p.z * per_metre)},
                         static_cast<std::uint32_t>(points.size())});
      points.push_back(p);
    }
  };
  for (const city::Polygon& polygon : object.polygons) {
    add(polygon.exterior);
    for (const city::Ring& hole : polygon.interiors) add(hole);
  }
  std::sort(corners.begin(), corners.end());
  std::vector<std::uint32_t> vertex(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i == 0 || corners[i].cell != corners[i - 1].cell)
      places_.push_back(points[corners[i].index]);
    vertex[corners[i].index] = static_cast<std::uint32_t>(places_.size() - 1);
  }
  std::size_t at = 0;
  const auto add_edges = [&](const city::Ring& ring, std::uint32_t polygon, bool backwards) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      std::uint32_t a = vertex[at + i], b = vertex[at + (i + 1) % ring.size()];
      if (a == b) continue;
      if (backwards) std::swap(a, b);
      uses_.push_back({std::min(a, b), std::max(a, b), polygon, a < b});
    }
    at += ring.size();
  };
  for (std::uint32_t i = 0; i < object.polygons.size(); ++i) {
    const city::Polygon& polygon = object.polygons[i];
    add_edges(polygon.exterior, i, false);
    if (polygon.interiors.empty()) continue;
    // A hole runs against its shell, or is turned here so that it does.
    const glm::dvec3 normal = city::area_vector(polygon.exterior);
    for (const city::Ring& hole : polygon.interiors)
      add_edges(hole, i, glm::dot(city::area_vector(hole), normal) > 0);
  }
}

void EdgeTable::index_uses(std::size_t polygons) {
  std::sort(uses_.begin(), uses_.end(), comes_before);
  begin_.resize(uses_.size());
  end_.resize(uses_.size());
  first_.assign(polygons + 1, 0);
  for (std::uint32_t i = 0; i < uses_.size();) {
    std::uint32_t end = i + 1;
    while (end < uses_.size() && uses_[end].same_edge(uses_[i])) ++end;
    for (std::uint32_t k = i; k < end; ++k) {
      begin_[k] = i;
      end_[k] = end;
      ++first_[uses_[k].polygon + 1];
    }
    i = end;
  }
  for (std::size_t p = 0; p < polygons; ++p) first_[p + 1] += first_[p];
  of_polygon_.resize(uses_.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < uses_.size(); ++i) of_polygon_[next[uses_[i].polygon]++] = i;
}

// No camera sees such a wall, whichever way it faces.
void EdgeTable::leave_out_inner_walls(std::size_t polygons) {
  std::vector<bool> inner(polygons, false);
  bool any = false;
  for (std::uint32_t p = 0; p < polygons; ++p) {
    const auto own = of_polygon(p);
    inner[p] = !own.empty() && std::all_of(own.begin(), own.end(),
                                           [&](std::uint32_t i) { return edge_of(i).size() > 2; });
    any = any || inner[p];
  }
  if (!any) return;
  std::erase_if(uses_, [&](const EdgeUse& use) { return inner[use.polygon]; });
  index_uses(polygons);
}

}  // namespace nightcity::mesh
