// Triangles of a city object's polygons.
#pragma once

#include "tools/mesh/mesh_report.h"
#include "tools/mesh/triangle_mesh.h"

namespace nightcity::mesh {

/// Triangulates every polygon of `object` (coordinates E, N, H in metres). What the exterior encloses
/// (an odd number of times) and no hole does is triangulated. The area of each polygon is kept to
/// 1e-6 relative. Bad rings are counted in `report` and never throw.
TriangleMesh triangulate(const city::CityObject& object, MeshReport& report);

}  // namespace nightcity::mesh
