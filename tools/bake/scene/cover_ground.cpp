#include "tools/bake/scene/cover_ground.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "formats/error.h"
#include "tools/bake/scene/ground_facets.h"
#include "tools/bake/scene/kerbs.h"
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

// A greater step is one of the ground itself.
constexpr double same_height_m = 1e-3;
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
  // `corner`: the origin of the part's coordinates.
  Coverer(const ground_cover::Cover& cover, const ground_cover::CoverPart& part,
          const glm::dvec2& corner, std::vector<Stored>& out, CoverCounts& counts)
      : cover_(cover), part_(part), corner_(corner), out_(out), counts_(counts) {}

  // Covers triangles that no outline crosses.
  void cover_whole(const std::vector<Stored>& whole) {
    const mesh::OwnerFinder areas(part_.areas), markings(part_.markings), ramps(part_.ramps);
    for (const Stored& triangle : whole) {
      const glm::dvec2 middle = (to_plan(triangle.corners[0]) + to_plan(triangle.corners[1]) +
                                 to_plan(triangle.corners[2])) /
                                3.0;
      Stored made = triangle;
      made.picture = 0;  // its corners are others
      const Surface* surface = find_surface(areas.find(middle));
      const std::uint32_t ramp = ramps.find(middle);
      apply(surface, markings.find(middle), made);
      for (glm::vec3& corner : made.corners)
        corner.y -= static_cast<float>(find_depth_m(surface, ramp, to_plan(corner)));
      count(made);
      out_.push_back(made);
    }
  }

  // Cuts triangles along the outlines.
  void cover_cut(const std::vector<Stored>& cut) {
    const std::vector<mesh::PlaneLayer> layers{part_.areas, part_.markings, find_facets(cut),
                                               part_.ramps};
    const mesh::PlanePartition plan = mesh::partition(layers, max_outline_crossings);
    const GroundHeights heights(cut);
    std::vector<double> ground_m(plan.points.size(), std::nan(""));
    Kerbs kerbs(plan);
    lowering_m_.assign(plan.points.size(), std::nan(""));
    for (const mesh::PlanePartition::Triangle& piece : plan.triangles) {
      const std::vector<std::uint32_t>& owners = plan.owners[piece.region];
      if (owners[2] == mesh::no_label) continue;  // beyond the tile's ground
      const glm::dvec2 middle = (plan.points[piece.vertex[0]] + plan.points[piece.vertex[1]] +
                                 plan.points[piece.vertex[2]]) /
                                3.0;
      const Stored& facet = cut[owners[2]];
      Stored made = facet;
      made.picture = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2& p = plan.points[piece.vertex[k]];
        double& shared = ground_m[piece.vertex[k]];
        const double height = heights.find(p, middle, facet);
        if (std::isnan(shared)) shared = height;
        // Neighbours share the height of their corner to the last bit.
        made.corners[k] = to_model(p, std::abs(height - shared) < same_height_m ? shared : height);
      }
      const Surface* surface = find_surface(owners[0]);
      apply(surface, owners[1], made);
      glm::dvec3 depth_m{0};
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t vertex = piece.vertex[k];
        depth_m[k] =
            share_lowering(vertex, surface, find_depth_m(surface, owners[3], plan.points[vertex]));
        made.corners[k].y -= static_cast<float>(depth_m[k]);
      }
      count(made);
      out_.push_back(made);
      kerbs.remember(piece, depth_m);
    }
    kerbs.add_to(ground_m, out_);
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
  }

  // `ramp`: number of the facet of a ramp, which lowers what is not sunken. `place`: in the part.
  double find_depth_m(const Surface* surface, std::uint32_t ramp, const glm::dvec2& place) const {
    if (surface && surface->sunken) return roads::kerb_m;
    if (ramp == mesh::no_label) return 0;
    return std::clamp(cover_.ramps()[ramp].find_lowering_m(place + corner_), 0.0, roads::kerb_m);
  }

  // Outlines are rounded to a millimetre, so neighbouring facets differ by less than that where
  // they meet: they share the lowering of their corner to the last bit.
  double share_lowering(std::uint32_t vertex, const Surface* surface, double depth_m) {
    if (surface && surface->sunken) return depth_m;
    double& shared = lowering_m_[vertex];
    if (std::isnan(shared)) shared = depth_m;
    return std::abs(depth_m - shared) < same_height_m ? shared : depth_m;
  }

  void count(const Stored& triangle) {
    const double area_m2 = std::abs(plan_area(triangle));
    if (const auto kind = to_ground_kind(triangle.material))
      counts_.area_m2[static_cast<std::size_t>(*kind)] += area_m2;
    else
      counts_.bare_m2 += area_m2;
  }

  const ground_cover::Cover& cover_;
  const ground_cover::CoverPart& part_;
  glm::dvec2 corner_;
  std::vector<Stored>& out_;
  CoverCounts& counts_;
  std::vector<double> lowering_m_;  // by ramps, at the partition's points
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
  for (const mesh::PlaneLayer* layer : {&part.areas, &part.markings, &part.ramps})
    for (const mesh::PlaneArea& area : *layer)
      for (const auto& ring : area.rings) lines.add_ring(ring);
  std::vector<Stored> cut, whole;
  for (const Stored& triangle : ground)
    (lines.meets(find_plan_box({triangle})) ? cut : whole).push_back(triangle);
  CoverCounts own;
  try {
    Coverer coverer(cover, part, corner, covered, own);
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
