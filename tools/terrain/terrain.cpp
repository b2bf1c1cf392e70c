#include "tools/terrain/terrain.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "tools/terrain/made_surface.h"

namespace nightcity {
namespace {

// Exact predicates: a ray through an edge shared by two triangles hits at least one of them.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangle = Kernel::Triangle_3;
using Triangles = std::vector<Triangle>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

constexpr double least_plan_area_m2 = 1e-8;  // below it a triangle is a wall or a line

double plan_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
}

/// Height of the triangle's plane at (x, y).
double height_on(const Triangle& triangle, double x, double y) {
  const auto &a = triangle[0], &b = triangle[1], &c = triangle[2];
  const double ux = b.x() - a.x(), uy = b.y() - a.y(), vx = c.x() - a.x(), vy = c.y() - a.y();
  const double area = ux * vy - uy * vx;
  const double s = ((x - a.x()) * vy - (y - a.y()) * vx) / area,
               t = ((y - a.y()) * ux - (x - a.x()) * uy) / area;
  return a.z() + s * (b.z() - a.z()) + t * (c.z() - a.z());
}

}  // namespace

struct Terrain::State {
  struct Layer {
    Triangles triangles;
    Tree tree;
  };
  std::array<Layer, 4> layers;
  std::optional<glm::dvec3> origin;  // coordinates are kept relative to it: EPSG eastings cost digits
  std::vector<glm::dvec3> ground_points, road_points;
  double lowest = std::numeric_limits<double>::infinity(), highest = -std::numeric_limits<double>::infinity();
  TriangleMesh made;

  /// The highest triangle of a layer on the vertical line through `p` (local).
  std::optional<double> highest_on(const Layer& layer, const glm::dvec2& p) const {
    if (layer.triangles.empty()) return std::nullopt;
    const Kernel::Segment_3 line({p.x, p.y, lowest - 1}, {p.x, p.y, highest + 1});
    std::vector<Triangles::const_iterator> hits;
    layer.tree.all_intersected_primitives(line, std::back_inserter(hits));
    std::optional<double> best;
    for (const auto& hit : hits) {
      const double z = height_on(*hit, p.x, p.y);
      if (!best || z > *best) best = z;
    }
    return best;
  }
};

Terrain::Terrain() : state_(std::make_unique<State>()) {}
Terrain::~Terrain() = default;
Terrain::Terrain(Terrain&&) noexcept = default;
Terrain& Terrain::operator=(Terrain&&) noexcept = default;

void Terrain::add(const TriangleMesh& mesh, Footing footing) {
  State& state = *state_;
  for (const MeshTriangle& triangle : mesh.triangles) {
    const glm::dvec3 &a = mesh.positions[triangle.vertex[0]], &b = mesh.positions[triangle.vertex[1]],
                     &c = mesh.positions[triangle.vertex[2]];
    // Not finite fails the comparison too.
    if (!(plan_area(a, b, c) > least_plan_area_m2) || !std::isfinite(a.z + b.z + c.z)) continue;
    if (!state.origin) state.origin = glm::dvec3(std::floor(a.x), std::floor(a.y), 0);
    const auto local = [&](const glm::dvec3& p) {
      state.lowest = std::min(state.lowest, p.z);
      state.highest = std::max(state.highest, p.z);
      if (footing == Footing::ground_surface) state.ground_points.push_back(p);
      if (footing == Footing::road) state.road_points.push_back(p);
      return Kernel::Point_3(p.x - state.origin->x, p.y - state.origin->y, p.z);
    };
    state.layers[static_cast<std::size_t>(footing)].triangles.emplace_back(local(a), local(b), local(c));
  }
}

void Terrain::build(double margin_m) {
  State& state = *state_;
  if (state.layers[0].triangles.empty()) {
    state.made = make_surface(
        std::move(state.ground_points.empty() ? state.road_points : state.ground_points), margin_m);
    add(state.made, Footing::terrain);
  }
  state.ground_points = {};
  state.road_points = {};
  for (State::Layer& layer : state.layers) {
    layer.tree.insert(layer.triangles.begin(), layer.triangles.end());
    layer.tree.build();
  }
}

std::optional<Terrain::Hit> Terrain::height_at(const glm::dvec2& east_north) const {
  if (!state_->origin || !std::isfinite(east_north.x + east_north.y)) return std::nullopt;
  const glm::dvec2 local = east_north - glm::dvec2(*state_->origin);
  for (std::size_t n = 0; n < state_->layers.size(); ++n)
    if (const auto height = state_->highest_on(state_->layers[n], local))
      return Hit{*height, static_cast<Footing>(n)};
  return std::nullopt;
}

std::optional<double> Terrain::height_of(Footing footing, const glm::dvec2& east_north) const {
  if (!state_->origin || !std::isfinite(east_north.x + east_north.y)) return std::nullopt;
  return state_->highest_on(state_->layers[static_cast<std::size_t>(footing)],
                            east_north - glm::dvec2(*state_->origin));
}

bool Terrain::inside_building(const glm::dvec2& east_north) const {
  if (!state_->origin || !std::isfinite(east_north.x + east_north.y)) return false;
  const glm::dvec2 local = east_north - glm::dvec2(*state_->origin);
  for (const Footing footing : {Footing::ground_surface, Footing::roof})
    if (state_->highest_on(state_->layers[static_cast<std::size_t>(footing)], local)) return true;
  return false;
}

const TriangleMesh& Terrain::made_surface() const {
  return state_->made;
}

}  // namespace nightcity
