#include "tools/terrain/outline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "tools/random.h"

namespace nightcity::terrain {
namespace {

constexpr double min_triangle_m2 = 1e-8, min_ring_area_m2 = 1, farthest_m = 1e12;

double plan_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
}

double plan_area(const std::vector<glm::dvec3>& ring) {
  double area = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    area += plan_area(ring[0], ring[i], ring[i + 1]);
  return area;
}

std::array<std::int64_t, 2> to_millimetres(const glm::dvec3& p) {
  return {std::llround(p.x * 1000), std::llround(p.y * 1000)};
}

}  // namespace

std::size_t Outline::EdgeHash::operator()(const Edge& edge) const {
  std::uint64_t hash = 0;
  for (const Place& place : {edge.from, edge.to})
    for (const std::int64_t v : place) hash = mix(hash ^ static_cast<std::uint64_t>(v));
  return hash;
}

void Outline::add(const mesh::TriangleMesh& mesh) {
  for (const mesh::MeshTriangle& triangle : mesh.triangles) {
    const glm::dvec3 corners[] = {mesh.positions[triangle.vertex[0]],
                                  mesh.positions[triangle.vertex[1]],
                                  mesh.positions[triangle.vertex[2]]};
    const double area = plan_area(corners[0], corners[1], corners[2]);
    const auto is_near = [](const glm::dvec3& p) {  // false for NaN too
      return std::abs(p.x) + std::abs(p.y) + std::abs(p.z) < farthest_m;
    };
    if (!std::all_of(std::begin(corners), std::end(corners), is_near) ||
        !(std::abs(area) > min_triangle_m2))
      continue;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 &a = corners[k], &b = corners[(k + 1) % 3];
      const std::int64_t on_the_left = area > 0 ? 1 : -1;
      Edge edge{to_millimetres(a), to_millimetres(b)};
      if (edge.from == edge.to) continue;
      if (edge.from < edge.to) {
        add_edge(edge, {on_the_left, a, b});
      } else {
        std::swap(edge.from, edge.to);
        add_edge(edge, {-on_the_left, b, a});
      }
    }
  }
}

void Outline::add(const Outline& other) {
  for (const auto& [edge, sides] : other.edges_) add_edge(edge, sides);
}

void Outline::add_edge(const Edge& edge, const Sides& sides) {
  const auto [found, is_new] = edges_.try_emplace(edge, sides);
  if (is_new) return;
  found->second.surplus += sides.surplus;
  if (found->second.surplus == 0) edges_.erase(found);
}

std::vector<std::vector<glm::dvec3>> Outline::find_rings() const {
  // The edges that go on from each place, with the ground on their left.
  std::map<Place, std::vector<std::pair<Place, glm::dvec3>>> onward;
  for (const auto& [edge, sides] : edges_)
    for (std::int64_t n = 0; n < std::abs(sides.surplus); ++n)
      if (sides.surplus > 0)
        onward[edge.from].emplace_back(edge.to, sides.to);
      else
        onward[edge.to].emplace_back(edge.from, sides.from);
  for (auto& [place, edges] : onward)
    std::sort(edges.begin(), edges.end(),
              [](const auto& a, const auto& b) { return a.first > b.first; });

  std::vector<std::vector<glm::dvec3>> rings;
  std::vector<std::pair<Place, glm::dvec3>> path;
  std::map<Place, std::size_t> on_path;  // where in it
  const auto cut_ring = [&](std::size_t first) {
    std::vector<glm::dvec3> ring;
    for (std::size_t i = first; i < path.size(); ++i) {
      ring.push_back(path[i].second);
      on_path.erase(path[i].first);
    }
    path.resize(first);
    if (plan_area(ring) >= min_ring_area_m2) rings.push_back(std::move(ring));
  };
  for (auto& [start, edges] : onward)
    while (!edges.empty()) {
      // As many edges come to a place as go on from it, so the path ends where it began.
      std::pair<Place, glm::dvec3> next = edges.back();
      edges.pop_back();
      while (true) {
        if (const auto met = on_path.find(next.first); met != on_path.end()) cut_ring(met->second);
        on_path[next.first] = path.size();
        path.push_back(next);
        const auto at = onward.find(next.first);
        if (at == onward.end() || at->second.empty()) break;
        next = at->second.back();
        at->second.pop_back();
      }
      cut_ring(0);
    }
  return rings;
}

}  // namespace nightcity::terrain
