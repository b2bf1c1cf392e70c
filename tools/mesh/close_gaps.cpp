#include "tools/mesh/close_gaps.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "tools/mesh/orient.h"
#include "tools/mesh/polygon_plane.h"

namespace nightcity::mesh {
namespace {

constexpr double crack_m = 0.01;
constexpr double min_height_m = 0.5;  // the outline of a flat roof alone has no inside to close
constexpr std::size_t max_open_vertices = 400;  // every pair is looked at

std::vector<EdgeUse> find_open_edges(const EdgeTable& edges) {
  std::vector<EdgeUse> open;
  for (std::size_t i = 0; i < edges.uses().size(); ++i)
    if (edges.edge_of(i).size() == 1) open.push_back(edges.uses()[i]);
  return open;
}

// A vertex at an open edge, and the one that it is moved to: itself, or the first within reach.
struct Join {
  std::uint32_t from, to;
};

// Returns the joins of all vertices at open edges, by `from`. Empty where nothing moves, or where
// the open edges would not pair up by that.
std::vector<Join> find_joins(const EdgeTable& edges, const std::vector<EdgeUse>& open) {
  std::vector<std::uint32_t> vertices;
  for (const EdgeUse& use : open) vertices.insert(vertices.end(), {use.low, use.high});
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  if (vertices.size() > max_open_vertices) return {};
  std::vector<Join> joins;
  for (const std::uint32_t vertex : vertices) joins.push_back({vertex, vertex});
  bool moved = false;
  for (std::size_t i = 0; i < joins.size(); ++i) {
    if (joins[i].to != joins[i].from) continue;
    const glm::dvec3& place = edges.place(joins[i].from);
    for (std::size_t j = i + 1; j < joins.size(); ++j) {
      const glm::dvec3& other = edges.place(joins[j].from);
      if (other.x - place.x > crack_m + EdgeTable::one_place_m) break;  // vertices go east
      if (joins[j].to == joins[j].from && glm::distance(place, other) <= crack_m) {
        joins[j].to = joins[i].from;
        moved = true;
      }
    }
  }
  if (!moved) return {};
  const auto find_target = [&](std::uint32_t vertex) {
    const auto before = [](const Join& join, std::uint32_t from) { return join.from < from; };
    return std::lower_bound(joins.begin(), joins.end(), vertex, before)->to;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> uses;
  for (const EdgeUse& use : open) {
    // A list, because of two temporaries minmax would return references.
    const auto [a, b] = std::minmax({find_target(use.low), find_target(use.high)});
    if (a != b) ++uses[{a, b}];
  }
  const bool closed =
      std::all_of(uses.begin(), uses.end(), [](const auto& use) { return use.second == 2; });
  return closed ? joins : std::vector<Join>();
}

void join(city::CityObject& object, const EdgeTable& edges, std::vector<Join> joins) {
  std::erase_if(joins, [](const Join& one) { return one.from == one.to; });
  const auto move = [&](city::Ring& ring) {
    for (glm::dvec3& p : ring)
      for (const Join& one : joins)
        if (glm::distance(p, edges.place(one.from)) < 0.002) p = edges.place(one.to);
  };
  for (city::Polygon& polygon : object.polygons) {
    move(polygon.exterior);
    for (city::Ring& hole : polygon.interiors) move(hole);
  }
}

// Returns the ring of places along the open edges, whichever way their polygons face. Empty unless
// they form one ring.
city::Ring find_ring(const EdgeTable& edges, const std::vector<EdgeUse>& open) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> next;
  for (const EdgeUse& use : open) {
    next[use.low].push_back(use.high);
    next[use.high].push_back(use.low);
  }
  city::Ring ring;
  const std::uint32_t start = next.begin()->first;
  for (std::uint32_t from = start, at = start;;) {
    const auto& ways = next.at(at);
    if (ways.size() != 2 || ring.size() > open.size()) return {};
    ring.push_back(edges.place(at));
    const std::uint32_t step = ways[0] == from ? ways[1] : ways[0];
    from = at;
    at = step;
    if (at == start) break;
  }
  return ring.size() == open.size() ? ring : city::Ring{};
}

bool is_floor(const city::CityObject& object, const city::Ring& ring) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const city::Polygon& polygon : object.polygons)
    for (const glm::dvec3& p : polygon.exterior) {
      low = std::min(low, p.z);
      high = std::max(high, p.z);
    }
  if (high - low < min_height_m) return false;
  return std::all_of(ring.begin(), ring.end(),
                     [low](const glm::dvec3& p) { return p.z - low <= crack_m; }) &&
         glm::length(city::area_vector(ring)) > crack_m;
}

}  // namespace

bool close_gaps_along(city::CityObject& object, const EdgeTable& edges, MeshReport& report) {
  const std::vector<EdgeUse> open = find_open_edges(edges);
  if (open.empty()) return false;
  const auto note = [&] {
    if (report.first_repaired.empty()) report.first_repaired = object.id;
  };
  if (std::vector<Join> joins = find_joins(edges, open); !joins.empty()) {
    join(object, edges, std::move(joins));
    ++report.cracks_closed;
    note();
    return true;
  }
  if (object.type != city::ObjectType::building) return false;
  city::Ring ring = find_ring(edges, open);
  if (ring.empty() || !is_floor(object, ring)) return false;
  if (city::area_vector(ring).z > 0) std::reverse(ring.begin(), ring.end());  // a floor faces down
  city::Polygon& floor = object.polygons.emplace_back();
  floor.surface = city::SurfaceType::ground;
  floor.exterior = std::move(ring);
  ++report.floors_added;
  note();
  return true;
}

void repair_shells(city::CityObject& object, MeshReport& report) {
  if (object.type == city::ObjectType::relief || !has_finite_places(object)) return;
  const EdgeTable edges(object);
  if (close_gaps_along(object, edges, report))
    orient_along(object, EdgeTable(object), report);
  else
    orient_along(object, edges, report);
}

}  // namespace nightcity::mesh
