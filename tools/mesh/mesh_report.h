// The faults of polygons found in meshing, and what was done about them.
#pragma once

#include <cstddef>
#include <string>

namespace nightcity::mesh {

/// Counts of the faults found and repaired; `worst_...` names the polygon with the worst of each
/// kind.
struct MeshReport {
  std::size_t polygons = 0, triangles = 0;
  std::size_t fast_path = 0;           // triangles and convex quads, no CGAL needed
  std::size_t zero_area = 0;           // left out
  std::size_t slivers = 0;             // kept: rings narrower than 1 cm on average
  std::size_t non_planar = 0;          // beyond 1 cm
  std::size_t self_intersecting = 0;   // kept, by parity; their area differs from their rings'
  std::size_t not_finite = 0;          // left out: NaN, infinite or beyond any frame
  std::size_t not_triangulated = 0;    // left out: CGAL gave up
  std::size_t crossing_too_often = 0;  // of these: more crossings than [city] max_crossings
  std::size_t too_many_points = 0;     // of these: more than [city] max_polygon_points
  std::size_t holes_left_out = 0;      // of fewer than three distinct vertices: they have no area
  std::size_t holes_outside = 0;       // reach beyond their exterior, and cut nothing out there
  std::string worst_hole_outside;      // the polygon whose holes do so most
  double worst_hole_outside_m2 = 0;    // the area of its holes there
  std::size_t turned = 0;              // polygons that orient_outward has turned
  std::string first_turned;            // id of the first object with such
  std::size_t cracks_closed = 0;       // objects closed by moving vertices together
  std::size_t floors_added = 0;        // objects closed by the ground surface they came without
  std::string first_repaired;          // id of the first object closed
  std::size_t corners_left_out = 0;    // of buildings, by [city] simplify_m
  std::size_t triangles_thinned = 0;   // fewer of relief, by [terrain] max_error_m
  std::size_t open_objects = 0;        // buildings without a closed shell, left as they are
  std::string worst_zero_area;         // the longest
  double worst_zero_area_m = 0;        // its perimeter
  std::string worst_sliver;            // the narrowest
  double worst_sliver_m = 0;           // its mean width
  std::string worst_non_planar;
  double worst_non_planar_m = 0;
  std::string worst_self_intersecting;
  /// Difference between the rings' own area vector and that of the triangles.
  double worst_self_intersecting_m2 = 0;

  void merge(const MeshReport& other);

  /// Passes each field to an archive (tools/archive.h).
  template <class Archive>
  void visit(Archive& archive) {
    archive(polygons, triangles, fast_path, zero_area, slivers, non_planar, self_intersecting,
            not_finite, not_triangulated, crossing_too_often, too_many_points, holes_left_out,
            holes_outside, worst_hole_outside, worst_hole_outside_m2, turned, first_turned,
            cracks_closed, floors_added, first_repaired, corners_left_out, triangles_thinned,
            open_objects);
    archive(worst_zero_area, worst_zero_area_m, worst_sliver, worst_sliver_m, worst_non_planar,
            worst_non_planar_m, worst_self_intersecting, worst_self_intersecting_m2);
  }
};

}  // namespace nightcity::mesh
