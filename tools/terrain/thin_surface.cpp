#include "tools/terrain/thin_surface.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "formats/finite.h"

namespace nightcity::terrain {
namespace {

using Index = std::uint32_t;
constexpr Index none = 0xFFFFFFFFu;

struct FaceInfo {
  bool outside = false;
  Index worst = none;  // the point in it whose error is greatest
  double error = 0;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<
    Kernel, CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;
using Face = Triangulation::Face_handle;
using Vertex = Triangulation::Vertex_handle;

double area_in_plan(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
}

// The vertices that triangles use, each place once, and the edges of the outline.
struct Field {
  std::vector<glm::dvec3> points;
  std::vector<bool> loose;
  std::unordered_map<Index, std::vector<Index>> outline;  // from a vertex to the next ones
  double area = 0;
};

// Returns nothing where the triangles are no height field.
std::optional<Field> make_field(const mesh::TriangleMesh& surface, const std::vector<bool>& loose) {
  Field field;
  std::map<std::pair<double, double>, Index> places;
  std::vector<Index> index_of(surface.positions.size(), none);
  const auto find = [&](Index vertex) -> Index {
    if (index_of[vertex] != none) return index_of[vertex];
    const glm::dvec3& p = surface.positions[vertex];
    const auto [found, is_new] =
        places.try_emplace({p.x, p.y}, static_cast<Index>(field.points.size()));
    if (is_new) {
      field.points.push_back(p);
      field.loose.push_back(!loose.empty() && loose[vertex]);
    }
    return index_of[vertex] = found->second;
  };
  std::map<std::pair<Index, Index>, int> edges;
  for (const mesh::MeshTriangle& triangle : surface.triangles) {
    std::array<Index, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3& p = surface.positions[triangle.vertex[k]];
      if (!finite(p)) return std::nullopt;
      corner[k] = find(triangle.vertex[k]);
      if (field.points[corner[k]].z != p.z) return std::nullopt;  // a step
    }
    const double area =
        area_in_plan(field.points[corner[0]], field.points[corner[1]], field.points[corner[2]]);
    if (!(area > 0)) return std::nullopt;
    field.area += area;
    for (std::size_t k = 0; k < 3; ++k)
      if (++edges[{corner[k], corner[(k + 1) % 3]}] > 1) return std::nullopt;
  }
  for (const auto& [edge, count] : edges)
    if (!edges.contains({edge.second, edge.first}))
      field.outline[edge.first].push_back(edge.second);
  return field;
}

class Thinner {
 public:
  Thinner(const Field& field, double max_error_m) : field_(field), max_error_(max_error_m) {}

  // Returns false where the outline crosses itself.
  bool make_outline() {
    std::vector<std::pair<Kernel::Point_2, Index>> input;
    for (const auto& [from, next] : field_.outline)
      if (!field_.loose[from]) input.emplace_back(place_of(from), from);
    std::sort(input.begin(), input.end(),
              [](const auto& a, const auto& b) { return a.second < b.second; });
    triangulation_.insert(input.begin(), input.end());
    std::unordered_map<Index, Vertex> vertices;
    for (auto v = triangulation_.finite_vertices_begin(); v != triangulation_.finite_vertices_end();
         ++v)
      vertices[v->info()] = v;
    for (const auto& [from, dropped] : input)
      for (Index to : field_.outline.at(dropped)) {
        while (field_.loose[to]) to = field_.outline.at(to).front();
        if (to != dropped) triangulation_.insert_constraint(vertices.at(dropped), vertices.at(to));
      }
    return triangulation_.number_of_vertices() == input.size() && input.size() >= 3;
  }

  void insert_what_is_needed() {
    std::vector<Waiting> waiting;
    for (Index n = 0; n < field_.points.size(); ++n)
      if (!field_.outline.contains(n)) waiting.push_back({n, Face(), {none, none, none}});
    // Neighbours in a row lie near each other, so that the walk to each begins beside it.
    while (true) {
      std::vector<Face> faces;
      Face near;
      for (Waiting& one : waiting) {
        near = locate(one, near);
        note_error(one, faces);
      }
      if (faces.empty()) return;
      std::vector<std::pair<Index, Face>> chosen;
      for (const Face& face : faces) {
        chosen.emplace_back(face->info().worst, face);
        face->info() = {};
      }
      std::vector<bool> is_chosen(field_.points.size());
      for (const auto& [point, face] : chosen) {
        is_chosen[point] = true;
        triangulation_.insert(place_of(point), face)->info() = point;
      }
      std::erase_if(waiting, [&](const Waiting& one) { return is_chosen[one.point]; });
    }
  }

  // Returns the triangles inside the outline; nothing where their area is another: some overlapped.
  std::optional<std::vector<std::array<Index, 3>>> take_triangles() {
    mark_outside();
    std::vector<std::array<Index, 3>> triangles;
    double area = 0;
    for (auto face = triangulation_.finite_faces_begin(); face != triangulation_.finite_faces_end();
         ++face) {
      if (face->info().outside) continue;
      triangles.push_back(
          {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
      area += area_in_plan(field_.points[triangles.back()[0]], field_.points[triangles.back()[1]],
                           field_.points[triangles.back()[2]]);
    }
    if (std::abs(area - field_.area) > 1e-9 * field_.area) return std::nullopt;
    return triangles;
  }

 private:
  // A point that is not in the surface, and the triangle that it lies in.
  struct Waiting {
    Index point;
    Face face;
    std::array<Index, 3> corners;  // of the face when the point was found in it
  };

  Kernel::Point_2 place_of(Index n) const { return {field_.points[n].x, field_.points[n].y}; }

  std::array<Index, 3> corners_of(const Face& face) const {
    std::array<Index, 3> corners;
    for (int k = 0; k < 3; ++k)
      corners[static_cast<std::size_t>(k)] =
          triangulation_.is_infinite(face->vertex(k)) ? none : face->vertex(k)->info();
    return corners;
  }

  // Finds the triangle of a point unless it is still the same. Insertion divides triangles and
  // turns edges, and removes no triangle: the one kept is still there.
  Face locate(Waiting& one, const Face& near) {
    if (one.face != Face() && corners_of(one.face) == one.corners) return one.face;
    one.face = triangulation_.locate(place_of(one.point), one.face != Face() ? one.face : near);
    one.corners = corners_of(one.face);
    return one.face;
  }

  double error_of(const Waiting& one) const {
    const glm::dvec3 &a = field_.points[one.corners[0]], &b = field_.points[one.corners[1]],
                     &c = field_.points[one.corners[2]], &p = field_.points[one.point];
    const double all = area_in_plan(a, b, c), at_a = area_in_plan(p, b, c) / all,
                 at_b = area_in_plan(a, p, c) / all;
    return std::abs(a.z * at_a + b.z * at_b + c.z * (1 - at_a - at_b) - p.z);
  }

  void note_error(const Waiting& one, std::vector<Face>& faces) {
    if (std::find(one.corners.begin(), one.corners.end(), none) != one.corners.end()) return;
    const double error = error_of(one);
    FaceInfo& info = one.face->info();
    if (!(error > max_error_) || (info.worst != none && error <= info.error)) return;
    if (info.worst == none) faces.push_back(one.face);
    info.worst = one.point;
    info.error = error;
  }

  // From outside inwards: each edge of the outline leads from one to the other.
  void mark_outside() {
    for (auto face = triangulation_.all_faces_begin(); face != triangulation_.all_faces_end();
         ++face)
      face->info().worst = none;  // none: not reached yet
    std::vector<std::pair<Face, bool>> ahead{{triangulation_.infinite_face(), true}};
    while (!ahead.empty()) {
      const auto [face, outside] = ahead.back();
      ahead.pop_back();
      if (face->info().worst != none) continue;
      face->info().worst = 0;
      face->info().outside = outside;
      for (int k = 0; k < 3; ++k) {
        const bool crosses = triangulation_.is_constrained({face, k});
        ahead.emplace_back(face->neighbor(k), outside != crosses);
      }
    }
  }

  const Field& field_;
  double max_error_;
  Triangulation triangulation_;
};

}  // namespace

mesh::TriangleMesh thin_surface(const mesh::TriangleMesh& surface, double max_error_m,
                                const std::vector<bool>& loose) {
  if (surface.triangles.size() < 3) return surface;
  const std::optional<Field> field = make_field(surface, loose);
  if (!field) return surface;
  Thinner thinner(*field, max_error_m);
  if (!thinner.make_outline()) return surface;
  thinner.insert_what_is_needed();
  const auto triangles = thinner.take_triangles();
  if (!triangles || triangles->size() >= surface.triangles.size()) return surface;
  mesh::TriangleMesh thin;
  std::vector<Index> index_of(field->points.size(), none);
  for (const std::array<Index, 3>& corners : *triangles) {
    mesh::MeshTriangle triangle = surface.triangles.front();
    for (std::size_t k = 0; k < 3; ++k) {
      Index& index = index_of[corners[k]];
      if (index == none) {
        index = static_cast<Index>(thin.positions.size());
        thin.positions.push_back(field->points[corners[k]]);
      }
      triangle.vertex[k] = index;
    }
    thin.triangles.push_back(triangle);
  }
  return thin;
}

std::vector<bool> find_needed(std::span<const double> heights, double max_error_m) {
  std::vector<bool> needed(heights.size());
  if (heights.empty()) return needed;
  needed.front() = needed.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> spans{{0, heights.size() - 1}};
  while (!spans.empty()) {
    const auto [begin, end] = spans.back();
    spans.pop_back();
    std::size_t worst = begin;
    double error = max_error_m;
    for (std::size_t n = begin + 1; n < end; ++n) {
      const double share = static_cast<double>(n - begin) / static_cast<double>(end - begin),
                   line = heights[begin] + share * (heights[end] - heights[begin]);
      if (std::abs(heights[n] - line) > error) {
        error = std::abs(heights[n] - line);
        worst = n;
      }
    }
    if (worst == begin) continue;
    needed[worst] = true;
    spans.emplace_back(begin, worst);
    spans.emplace_back(worst, end);
  }
  return needed;
}

}  // namespace nightcity::terrain
