// Makes a ground for cities that have none.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "tools/mesh/triangle_mesh.h"
#include "tools/terrain/surface_store.h"

namespace nightcity::terrain {

/// Returns a Delaunay surface (in plan) through `points`, with a rim `margin_m` outside their
/// bounds at the height of the nearest point, which also holds `reach`. Of points with the same
/// plan position the lowest counts. Empty without a finite point.
mesh::TriangleMesh make_surface(std::vector<glm::dvec3> points, double margin_m,
                                const std::optional<Extent>& reach = {});

struct BreakSurface {
  mesh::TriangleMesh mesh;
  std::size_t edges = 0;         // pieces of break lines that are edges of the surface
  std::size_t unused_edges = 0;  // pieces that are not: lines cross each other too often
};

/// The same through break lines as well (constrained Delaunay): every piece of a line is an edge of
/// the surface or several in a row, and no triangle reaches across it. Where lines cross, a vertex
/// is added at the height of one of them.
BreakSurface make_surface(std::vector<glm::dvec3> points,
                          std::span<const std::vector<glm::dvec3>> lines, double margin_m);

struct SurfaceAround {
  mesh::TriangleMesh mesh;
  std::size_t points = 0;  // of those given, those that lie outside
};

/// Returns a surface that goes on outside a ground: from the ground's outer `rings`
/// (Outline::find_rings), whose pieces are edges of it, through `points`, of which those inside do
/// not count, to a rim as above.
SurfaceAround make_surface_around(std::span<const std::vector<glm::dvec3>> rings,
                                  std::vector<glm::dvec3> points, double margin_m);

}  // namespace nightcity::terrain
