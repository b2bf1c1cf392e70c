#include "tools/mesh/mesh_report.h"

namespace nightcity::mesh {

void MeshReport::merge(const MeshReport& other) {
  polygons += other.polygons;
  triangles += other.triangles;
  fast_path += other.fast_path;
  if (other.zero_area > 0 && (zero_area == 0 || other.worst_zero_area_m > worst_zero_area_m)) {
    worst_zero_area_m = other.worst_zero_area_m;
    worst_zero_area = other.worst_zero_area;
  }
  zero_area += other.zero_area;
  if (other.slivers > 0 && (slivers == 0 || other.worst_sliver_m < worst_sliver_m)) {
    worst_sliver_m = other.worst_sliver_m;
    worst_sliver = other.worst_sliver;
  }
  slivers += other.slivers;
  non_planar += other.non_planar;
  not_finite += other.not_finite;
  not_triangulated += other.not_triangulated;
  crossing_too_often += other.crossing_too_often;
  too_many_points += other.too_many_points;
  holes_left_out += other.holes_left_out;
  holes_outside += other.holes_outside;
  if (other.worst_hole_outside_m2 > worst_hole_outside_m2) {
    worst_hole_outside_m2 = other.worst_hole_outside_m2;
    worst_hole_outside = other.worst_hole_outside;
  }
  turned += other.turned;
  if (first_turned.empty()) first_turned = other.first_turned;
  cracks_closed += other.cracks_closed;
  floors_added += other.floors_added;
  if (first_repaired.empty()) first_repaired = other.first_repaired;
  corners_left_out += other.corners_left_out;
  triangles_thinned += other.triangles_thinned;
  open_objects += other.open_objects;
  if (other.worst_non_planar_m > worst_non_planar_m) {
    worst_non_planar_m = other.worst_non_planar_m;
    worst_non_planar = other.worst_non_planar;
  }
  if (other.self_intersecting > 0 &&
      (self_intersecting == 0 || other.worst_self_intersecting_m2 > worst_self_intersecting_m2)) {
    worst_self_intersecting_m2 = other.worst_self_intersecting_m2;
    worst_self_intersecting = other.worst_self_intersecting;
  }
  self_intersecting += other.self_intersecting;
}

}  // namespace nightcity::mesh
