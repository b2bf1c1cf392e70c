// Turns polygons so that closed shells face outward. Nothing is guessed: a shell is turned only where its
// polygons meet edge to edge all round, for then inside and outside are facts.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tools/mesh/polygon_plane.h"
#include "tools/mesh/triangle_mesh.h"

namespace nightcity {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& c) const {
    std::uint64_t h = 0;
    for (const std::int64_t v : c) h = (h ^ static_cast<std::uint64_t>(v)) * 0x9E3779B97F4A7C15ull;
    return h ^ (h >> 32);
  }
};

struct Use {
  std::uint32_t polygon;
  bool forward;  // runs from the lower vertex number to the higher
};

// An edge of a polygon: the two vertex numbers, and which comes first.
struct Edge {
  std::uint64_t key;
  bool forward;
};

struct Shell {
  std::vector<std::uint32_t> polygons;
  bool consistent = true;  // no polygon had to face both ways
  bool closed = true;
  double volume = 0;  // with its polygons turned
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
};

class Orienter {
 public:
  explicit Orienter(CityObject& object) : object_(object), turned_(object.polygons.size(), false) {}

  std::size_t run() {
    collect_edges();
    leave_out_inner_walls();
    find_shells();
    std::size_t count = 0;
    for (std::size_t i = 0; i < shells_.size(); ++i) {
      const Shell& shell = shells_[i];
      if (!shell.consistent || !shell.closed || shell.volume == 0 || is_enclosed(i)) continue;
      for (const std::uint32_t p : shell.polygons) {
        if (turned_[p] == (shell.volume > 0)) {
          turn(object_.polygons[p]);
          ++count;
        }
      }
    }
    return count;
  }

 private:
  static void turn(Polygon& polygon) {
    std::reverse(polygon.exterior.begin(), polygon.exterior.end());
    for (Ring& ring : polygon.interiors) std::reverse(ring.begin(), ring.end());
  }

  std::uint32_t vertex(const glm::dvec3& p) {
    constexpr double per_metre = 1000;  // vertices within a millimetre are one
    const Cell cell{std::llround(p.x * per_metre), std::llround(p.y * per_metre),
                    std::llround(p.z * per_metre)};
    return vertices_.emplace(cell, static_cast<std::uint32_t>(vertices_.size())).first->second;
  }

  void add_ring(const Ring& ring, std::uint32_t polygon, bool backwards) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      std::uint32_t a = vertex(ring[i]), b = vertex(ring[(i + 1) % ring.size()]);
      if (a == b) continue;
      if (backwards) std::swap(a, b);
      const std::uint64_t key = (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
      edges_[key].push_back({polygon, a < b});
      edges_of_[polygon].push_back({key, a < b});
    }
  }

  void collect_edges() {
    edges_of_.resize(object_.polygons.size());
    for (std::uint32_t i = 0; i < object_.polygons.size(); ++i) {
      const Polygon& polygon = object_.polygons[i];
      const glm::dvec3 normal = area_vector(polygon.exterior);
      add_ring(polygon.exterior, i, false);
      // A hole runs against its shell, or is taken to.
      for (const Ring& hole : polygon.interiors) add_ring(hole, i, glm::dot(area_vector(hole), normal) > 0);
    }
  }

  // A wall between two parts of one building meets others at every one of its edges: without it, what is left
  // is the shell round both. Nobody sees such a wall, whichever way it faces.
  void leave_out_inner_walls() {
    std::vector<std::uint32_t> inner;
    for (std::uint32_t i = 0; i < edges_of_.size(); ++i)
      if (!edges_of_[i].empty() && std::all_of(edges_of_[i].begin(), edges_of_[i].end(),
                                               [&](const Edge& e) { return edges_.at(e.key).size() > 2; }))
        inner.push_back(i);
    for (const std::uint32_t i : inner) {
      for (const Edge& edge : edges_of_[i])
        std::erase_if(edges_.at(edge.key), [&](const Use& use) { return use.polygon == i; });
      edges_of_[i].clear();
    }
  }

  // Neighbours share an edge that no third polygon has; facing the same way, they run along it in opposite
  // directions.
  void find_shells() {
    std::vector<bool> seen(object_.polygons.size(), false);
    for (std::uint32_t start = 0; start < object_.polygons.size(); ++start) {
      if (seen[start] || edges_of_[start].empty()) continue;
      Shell shell;
      std::vector<std::uint32_t> open{start};
      seen[start] = true;
      while (!open.empty()) {
        const std::uint32_t p = open.back();
        open.pop_back();
        shell.polygons.push_back(p);
        for (const Edge& edge : edges_of_[p]) {
          const std::vector<Use>& uses = edges_.at(edge.key);
          if (uses.size() != 2 || uses[0].polygon == uses[1].polygon) continue;
          const Use &mine = uses[uses[0].polygon == p ? 0 : 1], &other = uses[uses[0].polygon == p ? 1 : 0];
          const bool turn_other = turned_[p] != (mine.forward == other.forward);
          if (!seen[other.polygon]) {
            seen[other.polygon] = true;
            turned_[other.polygon] = turn_other;
            open.push_back(other.polygon);
          } else if (turned_[other.polygon] != turn_other) {
            shell.consistent = false;
          }
        }
      }
      measure(shell);
      shells_.push_back(std::move(shell));
    }
  }

  void measure(Shell& shell) {
    std::sort(shell.polygons.begin(), shell.polygons.end());
    std::unordered_map<std::uint64_t, int> balance;
    const glm::dvec3 origin = object_.polygons[shell.polygons.front()].exterior.front();
    for (const std::uint32_t i : shell.polygons) {
      const Polygon& polygon = object_.polygons[i];
      glm::dvec3 vector = area_vector(polygon.exterior);
      for (const Ring& hole : polygon.interiors) {
        const glm::dvec3 h = area_vector(hole);
        vector -= glm::dot(h, vector) > 0 ? h : -h;
      }
      // Divergence theorem: a third of each face's area vector times any point of it.
      shell.volume += glm::dot(vector, polygon.exterior.front() - origin) / 3 * (turned_[i] ? -1 : 1);
      for (const glm::dvec3& p : polygon.exterior) {
        shell.low = glm::min(shell.low, p);
        shell.high = glm::max(shell.high, p);
      }
      for (const Edge& edge : edges_of_[i]) balance[edge.key] += edge.forward != turned_[i] ? 1 : -1;
    }
    shell.closed = std::all_of(balance.begin(), balance.end(), [](const auto& b) { return b.second == 0; });
  }

  // A shell within another may be its cavity, which faces the other way: nothing is shown there.
  bool is_enclosed(std::size_t i) const {
    constexpr std::size_t most_shells = 2000;  // beyond, every pair is too many: then nothing is turned
    if (shells_.size() > most_shells) return true;
    const Shell& inner = shells_[i];
    for (std::size_t j = 0; j < shells_.size(); ++j) {
      const Shell& outer = shells_[j];
      if (j != i && outer.closed && glm::all(glm::lessThan(outer.low, inner.low)) &&
          glm::all(glm::lessThan(inner.high, outer.high)))
        return true;
    }
    return false;
  }

  CityObject& object_;
  std::vector<bool> turned_;
  std::unordered_map<Cell, std::uint32_t, CellHash> vertices_;
  std::unordered_map<std::uint64_t, std::vector<Use>> edges_;
  std::vector<std::vector<Edge>> edges_of_;
  std::vector<Shell> shells_;
};

bool is_finite(const CityObject& object) {
  constexpr double beyond_any_frame_m = 1e9;
  for (const Polygon& polygon : object.polygons)
    for (const glm::dvec3& p : polygon.exterior)
      if (!(std::abs(p.x) + std::abs(p.y) + std::abs(p.z) < beyond_any_frame_m)) return false;
  return true;
}

}  // namespace

void orient_outward(CityObject& object, MeshReport& report) {
  if (object.type == ObjectType::relief || !is_finite(object)) return;
  const std::size_t turned = Orienter(object).run();
  if (turned == 0) return;
  report.turned += turned;
  if (report.first_turned.empty()) report.first_turned = object.id;
}

}  // namespace nightcity
