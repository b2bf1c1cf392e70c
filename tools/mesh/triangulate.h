// Triangles of a city object's polygons.
#pragma once

#include "tools/city/city_reader.h"
#include "tools/mesh/mesh_report.h"
#include "tools/mesh/triangle_mesh.h"

namespace nightcity::mesh {

/// Triangulates every polygon of `object` (coordinates E, N, H in metres). What the exterior
/// encloses (an odd number of times) and no hole does is triangulated. The area of each polygon is
/// kept to 1e-6 relative. Bad rings are counted in `report` and never throw; so are polygons beyond
/// `limits`.
TriangleMesh triangulate(const city::CityObject& object, MeshReport& report,
                         const city::PolygonLimits& limits = {});

}  // namespace nightcity::mesh
