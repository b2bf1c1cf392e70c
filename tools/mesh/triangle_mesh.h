// A triangulated city object, in the scene's projected frame (easting, northing, height).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "tools/city/city_model.h"

namespace nightcity::mesh {

struct MeshTriangle {
  std::uint32_t vertex[3];  // into TriangleMesh::positions, counter-clockwise seen from outside
  city::SurfaceType surface;
  std::uint32_t polygon;  // index of the source polygon in the object
};

struct TriangleMesh {
  std::vector<glm::dvec3> positions;  // E, N, H, m; double until the local origin is subtracted
  std::vector<MeshTriangle> triangles;
};

}  // namespace nightcity::mesh
