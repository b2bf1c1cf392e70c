#include "tools/mesh/triangulate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <glm/geometric.hpp>
#include <span>
#include <utility>

#include "formats/error.h"
#include "tools/mesh/constrained.h"
#include "tools/mesh/polygon_plane.h"

namespace nightcity::mesh {
namespace {

constexpr double planar_tolerance_m = 0.01;
constexpr double area_tolerance = 1e-6;  // relative; as promised in the header
// Below this share of its squared perimeter a ring's area is rounding noise: 10 nm of width for 10
// m of length.
constexpr double zero_area_share = 1e-10;
constexpr double sliver_width_m = 0.01;

bool is_usable(const city::Ring& ring) {
  constexpr double beyond_any_frame_m = 1e9;
  return std::all_of(ring.begin(), ring.end(), [](const glm::dvec3& p) {
    return std::abs(p.x) < beyond_any_frame_m && std::abs(p.y) < beyond_any_frame_m &&
           std::abs(p.z) < beyond_any_frame_m;  // false for NaN too
  });
}

double perimeter(const city::Ring& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    sum += glm::distance(ring[i], ring[(i + 1) % ring.size()]);
  return sum;
}

const std::string& name_of(const city::Polygon& polygon, const city::CityObject& object) {
  return polygon.id.empty() ? object.id : polygon.id;
}

// Returns the normal of a ring whose area vector cancels out (a bow-tie), not normalised: that of
// the triangle of its first vertex, the vertex farthest from that and the one farthest from their
// line. Zero when all lie on one line.
glm::dvec3 find_widest_normal(const city::Ring& ring) {
  const auto far_end =
      std::max_element(ring.begin(), ring.end(), [&](const glm::dvec3& a, const glm::dvec3& b) {
        return glm::distance(a, ring[0]) < glm::distance(b, ring[0]);
      });
  glm::dvec3 best{0};
  for (const glm::dvec3& p : ring) {
    const glm::dvec3 n = glm::cross(*far_end - ring[0], p - ring[0]);
    if (glm::length(n) > glm::length(best)) best = n;
  }
  return best;
}

struct Triangulator {
  const city::CityObject& object;
  MeshReport& report;
  const city::PolygonLimits& limits;
  TriangleMesh mesh;

  std::uint32_t add_positions(const city::Ring& ring) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), ring.begin(), ring.end());
    return first;
  }

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t polygon) {
    mesh.triangles.push_back(
        {{a, b, c}, object.polygons[polygon].surface, static_cast<std::uint32_t>(polygon)});
    ++report.triangles;
  }

  void check_planarity(const Plane& plane, std::span<const city::Ring> rings,
                       const std::string& id) {
    double worst = 0;
    for (const city::Ring& ring : rings)
      for (const glm::dvec3& p : ring) worst = std::max(worst, plane.distance(p));
    if (worst <= planar_tolerance_m) return;
    ++report.non_planar;
    if (worst > report.worst_non_planar_m) {
      report.worst_non_planar_m = worst;
      report.worst_non_planar = id;
    }
  }

  void count_zero_area(double length_m, const std::string& id) {
    ++report.zero_area;
    if (length_m <= report.worst_zero_area_m && report.zero_area > 1) return;
    report.worst_zero_area_m = length_m;
    report.worst_zero_area = id;
  }

  // Mean width: a long rectangle's area over half its perimeter.
  void check_width(double area, double length_m, const std::string& id) {
    const double width = 2 * area / length_m;
    if (width >= sliver_width_m) return;
    ++report.slivers;
    if (width >= report.worst_sliver_m && report.slivers > 1) return;
    report.worst_sliver_m = width;
    report.worst_sliver = id;
  }

  void count_self_intersecting(double lost_area, const std::string& id) {
    ++report.self_intersecting;
    if (lost_area <= report.worst_self_intersecting_m2 && report.self_intersecting > 1) return;
    report.worst_self_intersecting_m2 = lost_area;
    report.worst_self_intersecting = id;
  }

  // Adds a triangle, or a quad with a diagonal whose halves both face the ring's way: every simple
  // quad has one, a crossed one has none. Needs no CGAL and serves four fifths of real rings.
  // Returns false for all others.
  bool add_small(const city::Ring& ring, const glm::dvec3& normal, std::size_t polygon) {
    const auto facing = [&](int a, int b, int c) {
      const auto at = [&](int i) { return ring[static_cast<std::size_t>(i)]; };
      return glm::dot(glm::cross(at(b) - at(a), at(c) - at(a)), normal);
    };
    if (ring.size() == 3) {
      const std::uint32_t first = add_positions(ring);
      add_triangle(first, first + 1, first + 2, polygon);
      return true;
    }
    if (ring.size() != 4) return false;
    const double diagonal_02 = std::min(facing(0, 1, 2), facing(0, 2, 3));
    const double diagonal_13 = std::min(facing(1, 2, 3), facing(1, 3, 0));
    if (!(std::max(diagonal_02, diagonal_13) > 0)) return false;
    const std::uint32_t first = add_positions(ring), shift = diagonal_02 >= diagonal_13 ? 0 : 1;
    const auto corner = [&](std::uint32_t i) { return first + (i + shift) % 4; };
    add_triangle(corner(0), corner(1), corner(2), polygon);
    add_triangle(corner(0), corner(2), corner(3), polygon);
    return true;
  }

  // Counts the holes that reach beyond the exterior by more than rounding. Returns how much of the
  // holes lies there, m2.
  double count_holes_outside(const FlatTriangulation& flat, double area, const std::string& id) {
    double sum = 0;
    for (const double outside : flat.area_outside) {
      if (outside <= area_tolerance * area) continue;
      sum += outside;
      ++report.holes_outside;
    }
    if (sum > report.worst_hole_outside_m2) {
      report.worst_hole_outside_m2 = sum;
      report.worst_hole_outside = id;
    }
    return sum;
  }

  // Adds any polygon by CGAL. `ring_vector`: area vector of the rings themselves, holes subtracted.
  void add_any(std::span<const city::Ring> rings, const Plane& plane, glm::dvec3 ring_vector,
               std::size_t polygon) {
    std::vector<glm::dvec2> points;
    std::vector<std::vector<std::uint32_t>> outlines;
    city::Ring corners;
    for (const city::Ring& ring : rings) {
      std::vector<std::uint32_t>& outline = outlines.emplace_back();
      for (const glm::dvec3& p : ring) {
        outline.push_back(static_cast<std::uint32_t>(points.size()));
        points.push_back(plane.flatten(p));
        corners.push_back(p);
      }
    }
    FlatTriangulation flat;
    try {
      flat = triangulate_flat(points, outlines, static_cast<std::size_t>(limits.max_crossings));
    } catch (const Error&) {
      ++report.not_triangulated;
      ++report.crossing_too_often;
      return;
    } catch (const std::exception&) {  // CGAL refuses what is too degenerate
      ++report.not_triangulated;
      return;
    }
    for (std::size_t i = corners.size(); i < flat.points.size(); ++i)
      corners.push_back(plane.origin + flat.points[i].x * plane.u + flat.points[i].y * plane.v);
    glm::dvec3 vector{0};
    for (const auto& t : flat.triangles)
      vector += 0.5 * glm::cross(corners[t[1]] - corners[t[0]], corners[t[2]] - corners[t[0]]);
    const std::string& id = name_of(object.polygons[polygon], object);
    ring_vector +=
        plane.normal * count_holes_outside(flat, glm::length(city::area_vector(rings[0])), id);
    if (!(glm::dot(vector, plane.normal) > 0)) return count_zero_area(perimeter(rings[0]), id);
    // Outlines that cross leave another area than the rings' own; those that touch within rounding
    // do not.
    if (const double off = glm::distance(vector, ring_vector);
        off > area_tolerance * glm::length(ring_vector))
      count_self_intersecting(off, id);
    const std::uint32_t first = add_positions(corners);
    for (const auto& t : flat.triangles)
      add_triangle(first + t[0], first + t[1], first + t[2], polygon);
  }

  // Returns the polygon's rings without duplicate vertices: most have none, and then `cleaned`
  // stays empty.
  std::span<const city::Ring> clean(const city::Polygon& polygon,
                                    std::vector<city::Ring>& cleaned) {
    if (polygon.interiors.empty() && !has_duplicates(polygon.exterior))
      return {&polygon.exterior, 1};
    cleaned.push_back(remove_duplicates(polygon.exterior));
    if (cleaned.front().size() < 3) return cleaned;
    for (const city::Ring& interior : polygon.interiors) {
      city::Ring hole = remove_duplicates(interior);
      if (hole.size() < 3)
        ++report.holes_left_out;
      else
        cleaned.push_back(std::move(hole));
    }
    return cleaned;
  }

  bool is_too_long(const city::Polygon& polygon) const {
    std::size_t points = polygon.exterior.size();
    for (const city::Ring& interior : polygon.interiors) points += interior.size();
    return points > static_cast<std::size_t>(limits.max_points);
  }

  void add(std::size_t index) {
    const city::Polygon& polygon = object.polygons[index];
    ++report.polygons;
    if (is_too_long(polygon)) {
      ++report.not_triangulated;
      ++report.too_many_points;
      return;
    }
    if (!is_usable(polygon.exterior) ||
        !std::all_of(polygon.interiors.begin(), polygon.interiors.end(), is_usable)) {
      ++report.not_finite;
      return;
    }
    std::vector<city::Ring> cleaned;
    const std::span<const city::Ring> rings = clean(polygon, cleaned);
    const double length = perimeter(rings[0]), tiny = zero_area_share * length * length;
    if (rings[0].size() < 3) return count_zero_area(length, name_of(polygon, object));
    const glm::dvec3 vector = city::area_vector(rings[0]);
    glm::dvec3 normal = vector;
    if (glm::length(vector) <= tiny) {
      normal = find_widest_normal(rings[0]);
      if (glm::length(normal) <= tiny) return count_zero_area(length, name_of(polygon, object));
    } else {
      check_width(glm::length(vector), length, name_of(polygon, object));
    }
    normal = glm::normalize(normal);
    glm::dvec3 middle{0};
    for (const glm::dvec3& p : rings[0])
      middle += (p - rings[0][0]) / static_cast<double>(rings[0].size());
    const Plane plane = make_plane(rings[0][0] + middle, normal);
    check_planarity(plane, rings, name_of(polygon, object));
    if (rings.size() == 1 && glm::length(vector) > tiny && add_small(rings[0], normal, index)) {
      ++report.fast_path;
      return;
    }
    glm::dvec3 ring_vector = vector;
    for (std::size_t i = 1; i < rings.size(); ++i) {
      const glm::dvec3 hole = city::area_vector(rings[i]);  // holes may run either way
      ring_vector -= glm::dot(hole, normal) > 0 ? hole : -hole;
    }
    add_any(rings, plane, ring_vector, index);
  }
};

}  // namespace

TriangleMesh triangulate(const city::CityObject& object, MeshReport& report,
                         const city::PolygonLimits& limits) {
  Triangulator triangulator{object, report, limits, {}};
  for (std::size_t i = 0; i < object.polygons.size(); ++i) triangulator.add(i);
  return std::move(triangulator.mesh);
}

}  // namespace nightcity::mesh
