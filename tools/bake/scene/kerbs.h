// Kerbs: the upright faces between pieces of the ground of which one lies deeper than the other.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "tools/bake/scene/tile_store.h"
#include "tools/mesh/partition.h"

namespace nightcity::bake {

/// Returns a place of a tile's plan (x east, y north) in its model space.
inline glm::vec3 to_model(const glm::dvec2& plan, double height) {
  return glm::vec3(glm::dvec3(plan.x, height, -plan.y));
}

class Kerbs {
 public:
  /// `plan` must outlive it.
  explicit Kerbs(const mesh::PlanePartition& plan) : plan_(plan) {}

  /// Notes by how much the corners of a piece lie below the ground, m.
  void remember(const mesh::PlanePartition::Triangle& piece, const glm::dvec3& depth_m);
  /// Adds a kerb between any two pieces of which one lies deeper: the other ends there, and the
  /// kerb faces the deeper one. `ground_m`: heights of the ground at the plan's points.
  void add_to(const std::vector<double>& ground_m,
              std::vector<TileStore::StoredTriangle>& out) const;

 private:
  // An edge of a piece, from `a` to `b` counter-clockwise round it, and how deep its ends lie.
  struct Edge {
    std::uint32_t a, b;
    double a_depth_m, b_depth_m;
    double depth_at(std::uint32_t vertex) const { return vertex == a ? a_depth_m : b_depth_m; }
    double sum_m() const { return a_depth_m + b_depth_m; }
  };
  std::vector<std::pair<std::uint64_t, std::uint32_t>> sort_edges() const;
  void add(const Edge& low, const Edge& high, const std::vector<double>& ground_m,
           std::vector<TileStore::StoredTriangle>& out) const;

  const mesh::PlanePartition& plan_;
  std::vector<Edge> edges_;
};

}  // namespace nightcity::bake
