#include "tools/bake/scene/ground_facets.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <unordered_map>
#include <utility>

namespace nightcity::bake {
namespace {

using Stored = TileStore::StoredTriangle;

constexpr std::uint32_t none = mesh::no_label;

class FacetFinder {
 public:
  explicit FacetFinder(const std::vector<Stored>& triangles)
      : triangles_(triangles), corners_(triangles.size()), facet_of_(triangles.size(), none) {
    std::vector<glm::vec3> points;
    for (const Stored& triangle : triangles)
      points.insert(points.end(), triangle.corners, triangle.corners + 3);
    const auto is_before = [](const glm::vec3& a, const glm::vec3& b) {
      return std::tie(a.x, a.z, a.y) < std::tie(b.x, b.z, b.y);
    };
    std::sort(points.begin(), points.end(), is_before);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    points_ = std::move(points);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k)
        corners_[t][k] = static_cast<std::uint32_t>(
            std::lower_bound(points_.begin(), points_.end(), triangles[t].corners[k], is_before) -
            points_.begin());
      for (std::size_t k = 0; k < 3; ++k)
        triangle_of_.emplace(to_key(corners_[t][k], corners_[t][(k + 1) % 3]), t);
    }
  }

  mesh::PlaneLayer find() {
    // Large triangles first: their planes are the surest.
    std::vector<std::pair<float, std::uint32_t>> order;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      order.emplace_back(-glm::length(normal_of(t)), t);
    std::sort(order.begin(), order.end());
    mesh::PlaneLayer facets;
    for (const auto& [size, seed] : order)
      if (facet_of_[seed] == none) facets.push_back({trace(grow(seed)), seed});
    return facets;
  }

 private:
  static std::uint64_t to_key(std::uint32_t from, std::uint32_t to) {
    return std::uint64_t{from} << 32 | to;
  }

  glm::vec3 normal_of(std::uint32_t t) const {
    const glm::vec3* c = triangles_[t].corners;
    return glm::cross(c[1] - c[0], c[2] - c[0]);
  }

  // Returns the triangles that join the seed's plane, neighbour by neighbour.
  std::vector<std::uint32_t> grow(std::uint32_t seed) {
    const glm::dvec3 normal(normal_of(seed));
    const glm::dvec3 base(triangles_[seed].corners[0]);
    std::vector<std::uint32_t> facet{seed};
    facet_of_[seed] = seed;
    if (!(normal.y > 0)) return facet;
    const auto joins = [&](std::uint32_t t) {
      if (facet_of_[t] != none || triangles_[t].feature != triangles_[seed].feature ||
          !(normal_of(t).y > 0))
        return false;
      return std::all_of(corners_[t].begin(), corners_[t].end(), [&](std::uint32_t i) {
        return std::abs(glm::dot(normal, glm::dvec3(points_[i]) - base)) <=
               facet_tolerance_m * normal.y;
      });
    };
    for (std::size_t n = 0; n < facet.size(); ++n)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& c = corners_[facet[n]];
        const auto next = triangle_of_.find(to_key(c[(k + 1) % 3], c[k]));
        if (next == triangle_of_.end() || !joins(next->second)) continue;
        facet_of_[next->second] = seed;
        facet.push_back(next->second);
      }
    return facet;
  }

  // Returns the facet's outline: the edges that have it on one side only, joined into rings.
  std::vector<std::vector<glm::dvec2>> trace(const std::vector<std::uint32_t>& facet) const {
    std::multimap<std::uint32_t, std::uint32_t> edges;
    for (const std::uint32_t t : facet)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = corners_[t][k], b = corners_[t][(k + 1) % 3];
        const auto [first, last] = edges.equal_range(b);
        const auto back = std::find_if(first, last, [&](const auto& e) { return e.second == a; });
        if (back == last)
          edges.emplace(a, b);
        else
          edges.erase(back);
      }
    std::vector<std::vector<glm::dvec2>> rings;
    while (!edges.empty()) {
      std::vector<glm::dvec2>& ring = rings.emplace_back();
      // As many edges leave a corner as reach it, so a ring ends where it began.
      for (auto edge = edges.begin(); edge != edges.end();) {
        const std::uint32_t to = edge->second;
        ring.emplace_back(points_[edge->first].x, -double{points_[edge->first].z});
        edges.erase(edge);
        edge = edges.find(to);
      }
    }
    return rings;
  }

  const std::vector<Stored>& triangles_;
  std::vector<glm::vec3> points_;  // in order, each once
  std::vector<std::array<std::uint32_t, 3>> corners_;
  std::unordered_map<std::uint64_t, std::uint32_t> triangle_of_;  // by an edge
  std::vector<std::uint32_t> facet_of_;                           // its seed
};

}  // namespace

mesh::PlaneLayer find_facets(const std::vector<Stored>& triangles) {
  return FacetFinder(triangles).find();
}

}  // namespace nightcity::bake
