#include "tools/bake/scene/cover_ground.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "formats/error.h"
#include "tools/bake/scene/ground_facets.h"
#include "tools/bake/scene/line_grid.h"
#include "tools/mesh/partition.h"
#include "tools/roads/road_class.h"

namespace nightcity::bake {
namespace {

using ground_cover::Box;
using ground_cover::GroundKind;
using ground_cover::Marking;
using ground_cover::Surface;
using Stored = TileStore::StoredTriangle;

glm::dvec2 to_plan(const glm::vec3& corner) {
  return {corner.x, -double{corner.z}};
}

double plan_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  const glm::dvec2 u = b - a, v = c - a;
  return (u.x * v.y - u.y * v.x) / 2;
}

double plan_area(const Stored& t) {
  return plan_area(to_plan(t.corners[0]), to_plan(t.corners[1]), to_plan(t.corners[2]));
}

// Below this a triangle stands upright or has no extent.
constexpr double min_area_m2 = 1e-6;

bool can_be_covered(const Stored& triangle) {
  return triangle.material == to_code(BakeMaterial::terrain) &&
         std::abs(plan_area(triangle)) > min_area_m2;
}

// Returns the height of the triangle's plane at a place.
double height_at(const Stored& t, const glm::dvec2& place) {
  const glm::dvec2 a = to_plan(t.corners[0]), b = to_plan(t.corners[1]), c = to_plan(t.corners[2]);
  const double whole = plan_area(a, b, c), at_b = plan_area(a, place, c) / whole,
               at_c = plan_area(a, b, place) / whole, y = t.corners[0].y;
  return y + at_b * (t.corners[1].y - y) + at_c * (t.corners[2].y - y);
}

// Heights of triangles at places of the plan.
class GroundHeights {
 public:
  explicit GroundHeights(const std::vector<Stored>& triangles)
      : triangles_(triangles), layer_(make_layer(triangles)), finder_(layer_) {}
  // Returns the height at a corner of a piece whose middle is given. The place that decides which
  // triangle it is lies just within the piece. `facet`: whose plane serves if there is none.
  double find(const glm::dvec2& corner, const glm::dvec2& middle, const Stored& facet) const {
    const std::uint32_t found = finder_.find(corner + (middle - corner) * 1e-4);
    return height_at(found == mesh::no_label ? facet : triangles_[found], corner);
  }

 private:
  static mesh::PlaneLayer make_layer(const std::vector<Stored>& triangles) {
    mesh::PlaneLayer layer;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      const glm::vec3* c = triangles[i].corners;
      layer.push_back({{{to_plan(c[0]), to_plan(c[1]), to_plan(c[2])}}, i});
    }
    return layer;
  }

  const std::vector<Stored>& triangles_;
  mesh::PlaneLayer layer_;
  mesh::OwnerFinder finder_;
};

glm::vec3 to_model(const glm::dvec2& plan, double height) {
  return glm::vec3(glm::dvec3(plan.x, height, -plan.y));
}

// The plan of a tile's triangles of terrain.
Box find_plan_box(const std::vector<Stored>& ground) {
  Box box{to_plan(ground[0].corners[0]), to_plan(ground[0].corners[0])};
  for (const Stored& triangle : ground)
    for (const glm::vec3& corner : triangle.corners) {
      box.low = glm::min(box.low, to_plan(corner));
      box.high = glm::max(box.high, to_plan(corner));
    }
  return box;
}

class Coverer {
 public:
  Coverer(const ground_cover::Cover& cover, const ground_cover::CoverPart& part,
          std::vector<Stored>& out, CoverCounts& counts)
      : cover_(cover), part_(part), out_(out), counts_(counts) {}

  // Covers triangles that no outline crosses.
  void cover_whole(const std::vector<Stored>& whole) {
    const mesh::OwnerFinder areas(part_.areas), markings(part_.markings);
    for (const Stored& triangle : whole) {
      const glm::dvec2 middle = (to_plan(triangle.corners[0]) + to_plan(triangle.corners[1]) +
                                 to_plan(triangle.corners[2])) /
                                3.0;
      Stored made = triangle;
      apply(find_surface(areas.find(middle)), markings.find(middle), made);
      count(made);
      out_.push_back(made);
    }
  }

  // Cuts triangles along the outlines.
  void cover_cut(const std::vector<Stored>& cut) {
    const std::vector<mesh::PlaneLayer> layers{part_.areas, part_.markings, find_facets(cut)};
    const mesh::PlanePartition plan = mesh::partition(layers);
    const GroundHeights heights(cut);
    heights_.assign(plan.points.size(), std::nan(""));
    for (const mesh::PlanePartition::Triangle& piece : plan.triangles) {
      const std::vector<std::uint32_t>& owners = plan.owners[piece.region];
      if (owners[2] == mesh::no_label) continue;  // beyond the tile's ground
      const glm::dvec2 middle = (plan.points[piece.vertex[0]] + plan.points[piece.vertex[1]] +
                                 plan.points[piece.vertex[2]]) /
                                3.0;
      Stored made = cut[owners[2]];
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2& p = plan.points[piece.vertex[k]];
        double& shared = heights_[piece.vertex[k]];
        const double height = heights.find(p, middle, made);
        if (std::isnan(shared)) shared = height;
        // Neighbours share the height of their corner to the last bit.
        constexpr double step_m = 1e-3;  // a step in the ground itself
        made.corners[k] = to_model(p, std::abs(height - shared) < step_m ? shared : height);
      }
      const Surface* surface = find_surface(owners[0]);
      apply(surface, owners[1], made);
      const double depth_m = surface && surface->sunken ? roads::kerb_m : 0;
      count(made);
      out_.push_back(made);
      remember_edges(piece, depth_m);
    }
    add_kerbs(plan);
  }

 private:
  const Surface* find_surface(std::uint32_t label) const {
    return label == mesh::no_label ? nullptr : &cover_.surfaces()[label];
  }

  // `surface`: null where the ground is bare.
  static void apply(const Surface* surface, std::uint32_t marking, Stored& triangle) {
    const bool is_rail = marking == static_cast<std::uint32_t>(Marking::rail),
               is_painted = surface && surface->marked &&
                            marking == static_cast<std::uint32_t>(Marking::paint);
    if (!surface && !is_rail) return;
    triangle.material = to_code(is_rail      ? GroundKind::rail
                                : is_painted ? GroundKind::paint
                                             : surface->kind);
    triangle.feature = no_id;
    if (surface && surface->sunken)
      for (glm::vec3& corner : triangle.corners) corner.y -= static_cast<float>(roads::kerb_m);
  }

  void count(const Stored& triangle) {
    const double area_m2 = std::abs(plan_area(triangle));
    if (const auto kind = to_ground_kind(triangle.material))
      counts_.area_m2[static_cast<std::size_t>(*kind)] += area_m2;
    else
      counts_.bare_m2 += area_m2;
  }

  // An edge of a piece, from `a` to `b` counter-clockwise round it.
  struct Edge {
    std::uint32_t a, b;
    double depth_m;
  };

  void remember_edges(const mesh::PlanePartition::Triangle& piece, double depth_m) {
    for (std::size_t k = 0; k < 3; ++k)
      edges_.push_back({piece.vertex[k], piece.vertex[(k + 1) % 3], depth_m});
  }

  // Adds a kerb between two pieces of which one is sunken: the other ends there, and the kerb faces
  // the sunken one.
  void add_kerbs(const mesh::PlanePartition& plan) {
    const auto key = [](const Edge& e) { return std::minmax(e.a, e.b); };
    std::stable_sort(edges_.begin(), edges_.end(),
                     [&](const Edge& a, const Edge& b) { return key(a) < key(b); });
    for (std::size_t i = 0; i + 1 < edges_.size(); ++i) {
      const Edge &first = edges_[i], &second = edges_[i + 1];
      if (key(first) != key(second) || first.depth_m == second.depth_m) continue;
      const Edge& low = first.depth_m > second.depth_m ? first : second;
      const double drop_m = std::abs(first.depth_m - second.depth_m);
      const glm::dvec2 &a = plan.points[low.a], &b = plan.points[low.b];
      const glm::vec3 a_high = to_model(a, heights_[low.a]), b_high = to_model(b, heights_[low.b]);
      const glm::vec3 down(0, static_cast<float>(drop_m), 0);
      Stored kerb{{a_high - down, a_high, b_high}, to_code(GroundKind::kerb), no_id, 0};
      out_.push_back(kerb);
      kerb.corners[1] = b_high;
      kerb.corners[2] = b_high - down;
      out_.push_back(kerb);
    }
  }

  const ground_cover::Cover& cover_;
  const ground_cover::CoverPart& part_;
  std::vector<Stored>& out_;
  CoverCounts& counts_;
  std::vector<double> heights_;  // of the ground at the partition's points
  std::vector<Edge> edges_;
};

}  // namespace

void cover_ground(const ground_cover::Cover& cover, const glm::dvec3& origin,
                  std::vector<Stored>& triangles, CoverCounts& counts) {
  std::vector<Stored> ground, covered;
  for (const Stored& triangle : triangles)
    (can_be_covered(triangle) ? ground : covered).push_back(triangle);
  if (ground.empty()) return;
  const glm::dvec2 corner(origin);
  const Box box = find_plan_box(ground);
  const ground_cover::CoverPart part =
      cover.find_part({box.low + corner, box.high + corner}, corner);
  if (part.areas.empty() && part.markings.empty()) return;
  LineGrid lines(box);
  for (const mesh::PlaneLayer* layer : {&part.areas, &part.markings})
    for (const mesh::PlaneArea& area : *layer)
      for (const auto& ring : area.rings) lines.add_ring(ring);
  std::vector<Stored> cut, whole;
  for (const Stored& triangle : ground)
    (lines.meets(find_plan_box({triangle})) ? cut : whole).push_back(triangle);
  CoverCounts own;
  try {
    Coverer coverer(cover, part, covered, own);
    coverer.cover_whole(whole);
    coverer.cover_cut(cut);
  } catch (const Error&) {
    ++counts.uncut_tiles;
    return;
  }
  for (std::size_t i = 0; i < own.area_m2.size(); ++i) counts.area_m2[i] += own.area_m2[i];
  counts.bare_m2 += own.bare_m2;
  counts.triangles += covered.size() - std::min(covered.size(), triangles.size());
  triangles = std::move(covered);
}

}  // namespace nightcity::bake
