// A triangulated city object: the mesh stage's output, in the scene's projected frame (easting, northing,
// height).
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "tools/city/city_model.h"

namespace nightcity {

struct MeshTriangle {
  std::uint32_t vertex[3];  // into TriangleMesh::positions, counter-clockwise seen from outside
  SurfaceType surface;
  std::uint32_t polygon;  // index of the source polygon in the object
};

struct TriangleMesh {
  std::vector<glm::dvec3> positions;  // E, N, H, m; double until the local origin is subtracted
  std::vector<MeshTriangle> triangles;
};

/// Faults found while triangulating, counted; `worst` holds the id of the worst polygon of each kind.
struct MeshReport {
  std::size_t polygons = 0, triangles = 0;
  std::size_t fast_path = 0;          // triangles and convex quads, no CGAL needed
  std::size_t zero_area = 0;          // dropped
  std::size_t slivers = 0;            // kept: rings narrower than 1 cm on average
  std::size_t non_planar = 0;         // beyond 1 cm
  std::size_t self_intersecting = 0;  // kept, by parity; their area is not that of their rings
  std::size_t not_finite = 0;         // dropped: NaN, Inf or beyond any frame
  std::size_t not_triangulated = 0;   // dropped: CGAL gave up
  std::size_t dropped_holes = 0;  // holes of fewer than three distinct vertices: they have no area
  std::size_t turned = 0;         // polygons that orient_outward has turned
  std::string first_turned;       // id of the first object with such
  std::size_t cracks_closed =
      0;  // objects that repair_shells has closed by moving vertices together
  std::size_t floors_added = 0;  // ... by adding the ground surface they were published without
  std::string first_repaired;    // id of the first object with such
  std::size_t open_objects = 0;  // buildings whose surfaces form no closed shell, left as they are
  std::string worst_zero_area;   // the longest
  double worst_zero_area_m = 0;  // its perimeter
  std::string worst_sliver;      // the narrowest
  double worst_sliver_m = 0;     // its mean width
  std::string worst_non_planar;
  double worst_non_planar_m = 0;
  std::string worst_self_intersecting;
  double worst_self_intersecting_m2 =
      0;  // between the rings' own area vector and what parity leaves

  void merge(const MeshReport& other);
};

/// Triangulates every polygon of `object` (coordinates already E, N, H in metres). Holes by parity of
/// enclosing constraints. The area of each polygon is kept to 1e-6 relative. Never throws on bad rings: they
/// are counted.
TriangleMesh triangulate(const CityObject& object, MeshReport& report);

/// Whether every vertex is a place: finite, and within any frame.
bool has_finite_places(const CityObject& object);

/// Turns the polygons of every closed shell in `object` outward; counted in report.turned. Shells with a gap
/// or within another shell, and walls between parts, stay as they are. Coordinates in metres.
void orient_outward(CityObject& object, MeshReport& report);

/// Closes what is open in the shells of `object` where it can be shown what belongs there, then turns them
/// outward as orient_outward does. Cracks of up to a centimetre are closed by moving vertices together, and a
/// building that has all of its shell but the floor gets one; counted in `report`. What may be meant to be
/// open stays open. Coordinates E, N, H in metres.
void repair_shells(CityObject& object, MeshReport& report);

/// Names the surfaces a LoD1 block leaves unknown from their normals: roof, wall, ground. Buildings and
/// bridges only; what the file names stays. Coordinates already E, N, H.
void classify_unknown_surfaces(CityObject& object);

}  // namespace nightcity
