#include "tools/terrain/horizon.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "tools/mesh/partition.h"

namespace nightcity::terrain {
namespace {

// Bands around the ground, each twice as far from it as the one within, have vertices as far apart
// as twice their distance along its sides, and eight to a quarter of a turn. All are assumptions.
constexpr double first_band_m = 25;
constexpr int arc_pieces = 8, max_side_pieces = 64;
constexpr double min_level_m = 500, max_grade = 0.04;

// The heights of the surface.
class Heights {
 public:
  explicit Heights(std::span<const std::vector<glm::dvec3>> rings) {
    double sum = 0;
    for (const auto& ring : rings)
      for (const glm::dvec3& p : ring) {
        rim_.push_back(p);
        at_.try_emplace({p.x, p.y}, p.z);
        sum += p.z;
      }
    mean_m_ = sum / static_cast<double>(rim_.size());
    double steepest_m = 0;
    for (const glm::dvec3& p : rim_) steepest_m = std::max(steepest_m, std::abs(p.z - mean_m_));
    level_m_ = std::max(min_level_m, steepest_m / max_grade);
  }

  double find(const glm::dvec2& place) const {
    if (const auto own = at_.find({place.x, place.y}); own != at_.end()) return own->second;
    double square = std::numeric_limits<double>::infinity(), rim_m = mean_m_;
    for (const glm::dvec3& p : rim_) {
      const double dx = p.x - place.x, dy = p.y - place.y;
      if (dx * dx + dy * dy < square) square = dx * dx + dy * dy, rim_m = p.z;
    }
    const double share = std::max(0.0, 1 - std::sqrt(square) / level_m_);
    return mean_m_ + share * (rim_m - mean_m_) - square / (2 * earth_radius_m);
  }

 private:
  std::vector<glm::dvec3> rim_;
  std::map<std::pair<double, double>, double> at_;
  double mean_m_ = 0, level_m_ = 0;
};

// Returns the places at a distance from a rectangle: its sides moved outwards, and arcs between.
std::vector<glm::dvec2> make_band(const glm::dvec2& low, const glm::dvec2& high,
                                  double distance_m) {
  const glm::dvec2 corners[] = {low, {high.x, low.y}, high, {low.x, high.y}};
  const auto outwards = [&](double quarters) {
    const double angle = (quarters - 2) * std::numbers::pi / 2;
    return distance_m * glm::dvec2(std::cos(angle), std::sin(angle));
  };
  std::vector<glm::dvec2> ring;
  for (int k = 0; k < 4; ++k) {
    const glm::dvec2 &corner = corners[k], &next = corners[(k + 1) % 4];
    for (int n = 0; n < arc_pieces; ++n)
      ring.push_back(corner + outwards(k + double(n) / arc_pieces));
    const int pieces = static_cast<int>(std::clamp(
        std::ceil(glm::distance(corner, next) / (2 * distance_m)), 1.0, double{max_side_pieces}));
    for (int n = 0; n < pieces; ++n)
      ring.push_back(glm::mix(corner, next, double(n) / pieces) + outwards(k + 1));
  }
  return ring;
}

// Leaves out rings that lie in another one: land on the ground, which is no edge of it.
std::vector<std::vector<glm::dvec3>> leave_out_inner(
    std::span<const std::vector<glm::dvec3>> rings) {
  std::vector<std::pair<double, std::size_t>> by_size;
  std::vector<std::vector<glm::dvec2>> plans;
  for (const auto& ring : rings) {
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const glm::dvec3& p : ring) {
      low = glm::min(low, glm::dvec2(p));
      high = glm::max(high, glm::dvec2(p));
    }
    by_size.emplace_back(-(high.x - low.x) * (high.y - low.y), plans.size());
    plans.emplace_back(ring.begin(), ring.end());
  }
  std::sort(by_size.begin(), by_size.end());
  std::vector<std::vector<glm::dvec3>> outer;
  mesh::PlaneLayer kept;
  for (const auto& area_and_ring : by_size) {
    const std::size_t i = area_and_ring.second;
    const auto is_within = [&](const mesh::PlaneArea& area) {
      return std::all_of(plans[i].begin(), plans[i].end(),
                         [&](const glm::dvec2& p) { return mesh::holds(area.rings, p); });
    };
    if (std::any_of(kept.begin(), kept.end(), is_within)) continue;
    kept.push_back({{plans[i]}, 0});
    outer.push_back(rings[i]);
  }
  return outer;
}

}  // namespace

mesh::TriangleMesh make_horizon(std::span<const std::vector<glm::dvec3>> all_rings) {
  const std::vector<std::vector<glm::dvec3>> rings = leave_out_inner(all_rings);
  if (rings.empty()) return {};
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
  mesh::PlaneLayer ground, bands;
  for (const auto& ring : rings) {
    mesh::PlaneArea area{{{}}, 0};
    for (const glm::dvec3& p : ring) {
      area.rings[0].emplace_back(p);
      low = glm::min(low, glm::dvec2(p));
      high = glm::max(high, glm::dvec2(p));
    }
    ground.push_back(std::move(area));
  }
  std::uint32_t label = 0;
  for (double distance = first_band_m; distance < horizon_m; distance *= 2)
    bands.push_back({{make_band(low, high, distance)}, label++});
  bands.push_back({{make_band(low, high, horizon_m)}, label});

  const std::vector<mesh::PlaneLayer> layers{std::move(ground), std::move(bands)};
  const mesh::PlanePartition plan = mesh::partition(layers);
  const Heights heights(rings);
  mesh::TriangleMesh mesh;
  std::vector<std::uint32_t> index(plan.points.size(), mesh::no_label);
  for (const auto& triangle : plan.triangles) {
    if (plan.owners[triangle.region][0] != mesh::no_label) continue;  // the ground itself
    mesh::MeshTriangle made{{}, city::SurfaceType::terrain, 0};
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& vertex = index[triangle.vertex[static_cast<std::size_t>(k)]];
      if (vertex == mesh::no_label) {
        const glm::dvec2& p = plan.points[triangle.vertex[static_cast<std::size_t>(k)]];
        vertex = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.emplace_back(p, heights.find(p));
      }
      made.vertex[k] = vertex;
    }
    mesh.triangles.push_back(made);
  }
  return mesh;
}

}  // namespace nightcity::terrain
