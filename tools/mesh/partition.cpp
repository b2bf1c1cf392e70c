// The arrangement of all outlines is one constrained Delaunay triangulation. Its faces belong to
// cells, which no outline crosses, and one place decides to whom a cell belongs. A second
// triangulation keeps the outlines at which an owner changes: those between areas of one label are
// gone, as in a union of polygons.
#include "tools/mesh/partition.h"

#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "formats/error.h"
#include "formats/finite.h"
#include "tools/mesh/constrained_delaunay.h"
#include "tools/mesh/owner_finder.h"

namespace nightcity::mesh {
namespace {

constexpr std::uint32_t unset = std::numeric_limits<std::uint32_t>::max();

struct VertexInfo {
  std::uint32_t index = unset;
};
struct FaceInfo {
  std::uint32_t cell = unset;
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, PlaneKernel>;
// The tag splits outlines that cross.
using Triangulation =
    ConstrainedDelaunay<FaceInfo, VertexBase, PlaneKernel, CGAL::Exact_predicates_tag>;
using Face = Triangulation::Face_handle;
using Vertex = Triangulation::Vertex_handle;

glm::dvec2 to_plan(const Vertex& vertex) {
  return mesh::to_plan(vertex->point());
}

double area_of(const Face& face) {
  const glm::dvec2 a = to_plan(face->vertex(0)), b = to_plan(face->vertex(1)) - a,
                   c = to_plan(face->vertex(2)) - a;
  return (b.x * c.y - b.y * c.x) / 2;
}

using Edge = std::pair<glm::dvec2, glm::dvec2>;

bool is_before(const glm::dvec2& a, const glm::dvec2& b) {
  return std::pair(a.x, a.y) < std::pair(b.x, b.y);
}

using Pair = std::pair<std::uint32_t, std::uint32_t>;  // of points, the lesser first

class Arrangement {
 public:
  // Throws Error where crossings make more than `max_vertices`.
  Arrangement(const std::vector<Edge>& edges, std::size_t max_vertices) {
    const std::vector<std::uint32_t> ends = number_points(edges);
    insert_points();
    std::vector<Pair> pairs;  // each edge once
    for (std::size_t i = 0; i < ends.size(); i += 2)
      if (ends[i] != ends[i + 1]) pairs.emplace_back(std::minmax(ends[i], ends[i + 1]));
    pairs = join_overlaps(join_overlaps(std::move(pairs), 0), 1);
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    for (const auto& [a, b] : pairs) {
      triangulation_.insert_constraint(vertices_[a], vertices_[b]);
      if (triangulation_.number_of_vertices() > max_vertices)
        throw Error("", "outlines cross too often to be cut into regions");
    }
  }

  // Joins faces that no outline parts into cells and asks who owns each.
  void find_owners(std::span<const OwnerFinder> layers) {
    if (triangulation_.dimension() < 2) return;
    layers_ = layers.size();
    owners_.assign(layers_, no_label);  // of the outside
    spread(triangulation_.infinite_face(), 0);
    cells_ = 1;
    for (const Face face : triangulation_.finite_face_handles()) {
      if (face->info().cell != unset) continue;
      const glm::dvec2 place = spread(face, cells_++);
      for (const OwnerFinder& layer : layers) owners_.push_back(layer.find(place));
    }
  }

  // Returns the edges at which an owner changes.
  std::vector<Edge> find_borders() const {
    std::vector<Edge> edges;
    for (const auto& [face, i] : triangulation_.finite_edges()) {
      if (!face->is_constrained(i) || std::ranges::equal(owners_of(face->info().cell),
                                                         owners_of(face->neighbor(i)->info().cell)))
        continue;
      edges.emplace_back(to_plan(face->vertex(Triangulation::cw(i))),
                         to_plan(face->vertex(Triangulation::ccw(i))));
    }
    return edges;
  }

  PlanePartition take() {
    PlanePartition out;
    std::map<std::vector<std::uint32_t>, std::uint32_t> known;
    std::vector<std::uint32_t> regions(cells_, unset);  // of each cell
    for (const Face face : triangulation_.finite_face_handles()) {
      const std::span<const std::uint32_t> owners = owners_of(face->info().cell);
      if (std::all_of(owners.begin(), owners.end(), [](auto label) { return label == no_label; }))
        continue;
      std::uint32_t& region = regions[face->info().cell];
      if (region == unset) {
        const auto [at, is_new] = known.try_emplace({owners.begin(), owners.end()},
                                                    static_cast<std::uint32_t>(out.owners.size()));
        if (is_new) out.owners.push_back(at->first);
        region = at->second;
      }
      PlanePartition::Triangle& triangle = out.triangles.emplace_back();
      triangle.region = region;
      for (int k = 0; k < 3; ++k) {
        const Vertex vertex = face->vertex(k);
        if (vertex->info().index == unset) {
          vertex->info().index = static_cast<std::uint32_t>(out.points.size());
          out.points.push_back(to_plan(vertex));
        }
        triangle.vertex[static_cast<std::size_t>(k)] = vertex->info().index;
      }
    }
    return out;
  }

  bool is_flat() const { return triangulation_.dimension() < 2; }

 private:
  std::span<const std::uint32_t> owners_of(std::uint32_t cell) const {
    return std::span(owners_).subspan(cell * layers_, layers_);
  }

  // Gathers the different points of the edges, in order, and returns the numbers of each edge's
  // two ends among them.
  std::vector<std::uint32_t> number_points(const std::vector<Edge>& edges) {
    struct End {
      glm::dvec2 place;
      std::uint32_t number;  // among all ends
    };
    std::vector<End> ends;
    ends.reserve(2 * edges.size());
    for (const auto& [a, b] : edges)
      for (const glm::dvec2& place : {a, b})
        ends.push_back({place, static_cast<std::uint32_t>(ends.size())});
    std::sort(ends.begin(), ends.end(),
              [](const End& a, const End& b) { return is_before(a.place, b.place); });
    std::vector<std::uint32_t> numbers(ends.size());
    for (const End& end : ends) {
      if (points_.empty() || points_.back() != end.place) points_.push_back(end.place);
      numbers[end.number] = static_cast<std::uint32_t>(points_.size() - 1);
    }
    return numbers;
  }

  // Returns the edges with those of one coordinate along an axis, as outlines that were cut to a
  // rectangle have, cut at each other's ends. Where two of them overlap, a third that crosses both
  // would else split them in one rounded vertex, which lies on neither, and CGAL would lead one of
  // the three to an end far away.
  std::vector<Pair> join_overlaps(std::vector<Pair> pairs, int axis) const {
    const auto is_along = [&](const Pair& pair) {
      return points_[pair.first][axis] == points_[pair.second][axis];
    };
    const auto along = std::partition(pairs.begin(), pairs.end(),
                                      [&](const Pair& pair) { return !is_along(pair); });
    struct Turn {
      double line;
      std::uint32_t point;
      int edges;  // that begin here, less those that end
    };
    std::vector<Turn> turns;
    for (auto pair = along; pair != pairs.end(); ++pair) {
      turns.push_back({points_[pair->first][axis], pair->first, 1});
      turns.push_back({points_[pair->first][axis], pair->second, -1});
    }
    pairs.erase(along, pairs.end());
    // Numbers ascend along such a line, as points are in order.
    std::sort(turns.begin(), turns.end(), [](const Turn& a, const Turn& b) {
      return std::pair(a.line, a.point) < std::pair(b.line, b.point);
    });
    int edges = 0;
    for (std::size_t n = 0; n + 1 < turns.size(); ++n) {
      edges += turns[n].edges;
      if (edges > 0 && turns[n].point != turns[n + 1].point)
        pairs.emplace_back(turns[n].point, turns[n + 1].point);
    }
    return pairs;
  }

  // All at once, because CGAL inserts a range in space-filling order.
  void insert_points() {
    std::vector<std::pair<PlaneKernel::Point_2, VertexInfo>> input;
    input.reserve(points_.size());
    for (std::uint32_t i = 0; i < points_.size(); ++i)
      input.emplace_back(PlaneKernel::Point_2(points_[i].x, points_[i].y), VertexInfo{i});
    triangulation_.insert(input.begin(), input.end());
    vertices_.resize(points_.size());
    for (const Vertex vertex : triangulation_.finite_vertex_handles())
      vertices_[std::exchange(vertex->info().index, unset)] = vertex;
  }

  // Gives the cell's number to all its faces and returns the middle of the largest.
  glm::dvec2 spread(const Face& first, std::uint32_t cell) {
    open_.assign(1, first);
    first->info().cell = cell;
    Face largest = first;
    double largest_area = -1;
    while (!open_.empty()) {
      const Face face = open_.back();
      open_.pop_back();
      if (!triangulation_.is_infinite(face))
        if (const double area = area_of(face); area > largest_area)
          largest = face, largest_area = area;
      for (int i = 0; i < 3; ++i) {
        const Face next = face->neighbor(i);
        if (face->is_constrained(i) || next->info().cell != unset) continue;
        next->info().cell = cell;
        open_.push_back(next);
      }
    }
    if (largest_area < 0) return {};
    return (to_plan(largest->vertex(0)) + to_plan(largest->vertex(1)) +
            to_plan(largest->vertex(2))) /
           3.0;
  }

  Triangulation triangulation_;
  std::vector<glm::dvec2> points_;  // of the input, in order
  std::vector<Vertex> vertices_;    // of these points
  std::size_t layers_ = 0;
  std::uint32_t cells_ = 0;
  std::vector<std::uint32_t> owners_;  // of each cell, layer by layer
  std::vector<Face> open_;             // memory of spread()
};

}  // namespace

PlanePartition partition(std::span<const PlaneLayer> layers, std::size_t max_crossings_a_point) {
  std::vector<Edge> edges;
  std::vector<OwnerFinder> finders;
  finders.reserve(layers.size());
  for (const PlaneLayer& layer : layers) {
    finders.emplace_back(layer);
    for (const PlaneArea& area : layer)
      for (const auto& ring : area.rings) {
        std::vector<glm::dvec2> kept;
        for (const glm::dvec2& p : ring)
          if (finite(p)) kept.push_back(p);
        for (std::size_t i = 0; i < kept.size(); ++i)
          edges.emplace_back(kept[i], kept[(i + 1) % kept.size()]);
      }
  }
  const std::size_t max_vertices = (1 + max_crossings_a_point) * edges.size() + 3;
  Arrangement all(edges, max_vertices);
  if (all.is_flat()) return {};
  all.find_owners(finders);
  Arrangement regions(all.find_borders(), max_vertices);
  if (regions.is_flat()) return {};
  regions.find_owners(finders);
  return regions.take();
}

}  // namespace nightcity::mesh
