#include "tools/bake/scene/kerbs.h"

#include <algorithm>

#include "tools/bake/scene/materials.h"

namespace nightcity::bake {

void Kerbs::remember(const mesh::PlanePartition::Triangle& piece, const glm::dvec3& depth_m) {
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    edges_.push_back({piece.vertex[k], piece.vertex[next], depth_m[k], depth_m[next]});
  }
}

void Kerbs::add_to(const std::vector<double>& ground_m,
                   std::vector<TileStore::StoredTriangle>& out) const {
  const std::vector<std::pair<std::uint64_t, std::uint32_t>> order = sort_edges();
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    if (order[i].first != order[i + 1].first) continue;
    const Edge &first = edges_[order[i].second], &second = edges_[order[i + 1].second];
    if (first.sum_m() > second.sum_m())
      add(first, second, ground_m, out);
    else if (first.sum_m() < second.sum_m())
      add(second, first, ground_m, out);
  }
}

// Returns the numbers of the edges that a kerb may stand on, with keys that the two sides of an
// edge share, in order: those that touch what lies deeper than the ground.
std::vector<std::pair<std::uint64_t, std::uint32_t>> Kerbs::sort_edges() const {
  std::vector<bool> is_deep(plan_.points.size());
  for (const Edge& edge : edges_) {
    if (edge.a_depth_m > 0) is_deep[edge.a] = true;
    if (edge.b_depth_m > 0) is_deep[edge.b] = true;
  }
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  for (std::uint32_t i = 0; i < edges_.size(); ++i) {
    const auto [least, greatest] = std::minmax(edges_[i].a, edges_[i].b);
    if (is_deep[least] || is_deep[greatest])
      order.emplace_back(std::uint64_t{least} << 32 | greatest, i);
  }
  std::sort(order.begin(), order.end());
  return order;
}

void Kerbs::add(const Edge& low, const Edge& high, const std::vector<double>& ground_m,
                std::vector<TileStore::StoredTriangle>& out) const {
  const auto corner = [&](std::uint32_t vertex, const Edge& edge) {
    glm::vec3 p = to_model(plan_.points[vertex], ground_m[vertex]);
    p.y -= static_cast<float>(edge.depth_at(vertex));  // as the pieces' own corners
    return p;
  };
  const glm::vec3 a_low = corner(low.a, low), b_low = corner(low.b, low),
                  a_high = corner(low.a, high), b_high = corner(low.b, high);
  const auto add_triangle = [&](const glm::vec3& p, const glm::vec3& q, const glm::vec3& r) {
    if (p != q && q != r && r != p)
      out.push_back({{p, q, r}, to_code(ground_cover::GroundKind::kerb), no_id, 0, 0});
  };
  add_triangle(a_low, a_high, b_high);
  add_triangle(a_low, b_high, b_low);
}

}  // namespace nightcity::bake
