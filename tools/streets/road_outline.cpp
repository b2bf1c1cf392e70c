// A constrained triangulation of all rings shows for each face which surfaces cover it: crossing an
// edge of a ring enters or leaves that ring's surface.
#include "tools/streets/road_outline.h"

#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <string>

#include "formats/error.h"
#include "tools/mesh/constrained_delaunay.h"

namespace nightcity::streets {
namespace {

struct RoadFace {
  bool seen = false, road = false;
  bool counted = false;  // into an island
};

constexpr double grid_m = 0.01;  // corners that neighbours share differ by less

template <class Vertex>
const glm::dvec2& plan(const Vertex& v) {
  return v->info();
}

template <class Face>
double area(const Face& face) {
  const glm::dvec2 a = plan(face->vertex(0)), b = plan(face->vertex(1)) - a,
                   c = plan(face->vertex(2)) - a;
  return (b.x * c.y - b.y * c.x) / 2;
}

template <class Outlines>
class Outliner {
  using Kernel = typename Outlines::Kernel;
  using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<glm::dvec2, Kernel>;

 public:
  using Triangulation = CGAL::Constrained_triangulation_plus_2<
      mesh::ConstrainedDelaunay<RoadFace, VertexBase, Kernel, typename Outlines::Tag>>;

  Outliner(std::span<const RoadSurface> surfaces, int max_crossings)
      : max_crossings_(static_cast<std::size_t>(max_crossings)) {
    // Coordinates of millions of metres would make the triangulation's own corners inexact.
    origin_ = surfaces.front().exterior.front();
    for (std::uint32_t n = 0; n < surfaces.size(); ++n) {
      insert(surfaces[n].exterior, n);
      for (const PlanRing& hole : surfaces[n].interiors) insert(hole, n);
    }
    for (const Vertex v : triangulation_.finite_vertex_handles())
      v->info() = mesh::to_plan(v->point());
  }

  std::vector<OutlineEdge> run() {
    if (triangulation_.dimension() < 2) return {};
    mark_roads();
    close_gaps();
    fill_islands();
    std::vector<OutlineEdge> outline;
    for (const Face face : triangulation_.finite_face_handles()) {
      if (!face->info().road) continue;
      for (int i = 0; i < 3; ++i)
        if (!face->neighbor(i)->info().road)
          outline.emplace_back(plan(face->vertex(Triangulation::ccw(i))) + origin_,
                               plan(face->vertex(Triangulation::cw(i))) + origin_);
    }
    return outline;
  }

 private:
  using Face = typename Triangulation::Face_handle;
  using Vertex = typename Triangulation::Vertex_handle;
  using Cover = std::vector<std::uint32_t>;  // surfaces, ascending

  void insert(const PlanRing& ring, std::uint32_t surface) {
    std::vector<Vertex> vertices;
    points_ += ring.size();
    for (const glm::dvec2& p : ring) {
      const glm::dvec2 place = glm::round((p - origin_) / grid_m) * grid_m;
      const Vertex v = triangulation_.insert(typename Kernel::Point_2(place.x, place.y),
                                             last_ == Vertex{} ? Face{} : last_->face());
      last_ = v;
      vertices.push_back(v);
    }
    for (std::size_t n = 0; n < vertices.size(); ++n) {
      const Vertex a = vertices[n], b = vertices[(n + 1) % vertices.size()];
      if (a != b) surface_of_[triangulation_.insert_constraint(a, b)] = surface;
      if (triangulation_.number_of_vertices() > (1 + max_crossings_) * points_)
        throw Error("", "the model's roads cross each other more than " +
                            std::to_string(max_crossings_) +
                            " times for each of their points: raise [city] max_crossings in a "
                            "recipe, or give a map with streets, [osm] files");
    }
  }

  /// Returns the surfaces whose rings run along an edge an odd number of times.
  void cross(const Face& face, int i, Cover& cover) const {
    const Vertex a = face->vertex(Triangulation::ccw(i)), b = face->vertex(Triangulation::cw(i));
    for (auto context = triangulation_.contexts_begin(a, b);
         context != triangulation_.contexts_end(a, b); ++context) {
      const std::uint32_t surface = surface_of_.at(context->id());
      const auto place = std::lower_bound(cover.begin(), cover.end(), surface);
      if (place != cover.end() && *place == surface)
        cover.erase(place);
      else
        cover.insert(place, surface);
    }
  }

  void mark_roads() {
    std::vector<std::pair<Face, Cover>> open{{triangulation_.infinite_face(), {}}};
    open.back().first->info().seen = true;
    while (!open.empty()) {
      const auto [face, cover] = std::move(open.back());
      open.pop_back();
      for (int i = 0; i < 3; ++i) {
        const Face next = face->neighbor(i);
        if (next->info().seen) continue;
        Cover of_next = cover;
        if (face->is_constrained(i)) cross(face, i, of_next);
        next->info().seen = true;
        next->info().road = !of_next.empty();
        open.emplace_back(next, std::move(of_next));
      }
    }
  }

  /// Turns thin faces with road on both sides into road.
  void close_gaps() {
    std::vector<Face> gaps;
    for (const Face face : triangulation_.finite_face_handles())
      if (!face->info().road && is_gap(face)) gaps.push_back(face);
    for (const Face face : gaps) face->info().road = true;
  }

  bool is_gap(const Face& face) const {
    const glm::dvec2 corners[] = {plan(face->vertex(0)), plan(face->vertex(1)),
                                  plan(face->vertex(2))};
    glm::dvec2 longest(0);
    for (int i = 0; i < 3; ++i) {
      const glm::dvec2 edge = corners[(i + 1) % 3] - corners[i];
      if (glm::length(edge) > glm::length(longest)) longest = edge;
    }
    const double length = glm::length(longest);
    if (2 * area(face) >= gap_m * length) return false;
    const glm::dvec2 middle = (corners[0] + corners[1] + corners[2]) / 3.0,
                     aside = glm::dvec2(-longest.y, longest.x) * (1.5 * gap_m / length);
    const auto road_at = [&](const glm::dvec2& p) {
      return triangulation_.locate(typename Kernel::Point_2(p.x, p.y), face)->info().road;
    };
    return road_at(middle + aside) && road_at(middle - aside);
  }

  void fill_islands() {
    std::vector<Face> open, island;
    const auto gather = [&](const Face& first) {
      open.assign(1, first);
      island.clear();
      first->info().counted = true;
      double sum = 0;
      bool finite = true;
      while (!open.empty()) {
        const Face face = open.back();
        open.pop_back();
        island.push_back(face);
        if (triangulation_.is_infinite(face))
          finite = false;
        else
          sum += area(face);
        for (int i = 0; i < 3; ++i) {
          const Face next = face->neighbor(i);
          if (next->info().road || next->info().counted) continue;
          next->info().counted = true;
          open.push_back(next);
        }
      }
      return finite && sum < island_m2;
    };
    gather(triangulation_.infinite_face());
    for (const Face face : triangulation_.finite_face_handles())
      if (!face->info().road && !face->info().counted && gather(face))
        for (const Face part : island) part->info().road = true;
  }

  std::size_t max_crossings_, points_ = 0;  // points: of the rings so far
  Triangulation triangulation_;
  std::map<typename Triangulation::Constraint_id, std::uint32_t> surface_of_;
  glm::dvec2 origin_{0, 0};
  Vertex last_{};
};

}  // namespace

std::vector<OutlineEdge> road_outline(std::span<const RoadSurface> surfaces, int max_crossings) {
  if (surfaces.empty()) return {};
  using Uncrossed = Outliner<mesh::UncrossedOutlines>;
  try {
    return Uncrossed(surfaces, max_crossings).run();
  } catch (const Uncrossed::Triangulation::Intersection_of_constraints_exception&) {
    return Outliner<mesh::CrossedOutlines>(surfaces, max_crossings).run();
  }
}

}  // namespace nightcity::streets
