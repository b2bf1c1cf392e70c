// From the meshes of a scene file to instances and the hierarchies that rays traverse.
#pragma once

#include "runtime/scene/mesh_placement.h"
#include "runtime/scene/mesh_triangles.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::scene {

/// Appends the meshes of `scene`, their BLASes and instances, and builds the TLAS over these, all
/// relative to `out.origin`.
/// Triangles without area and instances whose matrix is singular are left out and counted. Vehicles
/// are left out where `out` has traffic, and what `filter` says. The result does not depend on the
/// number of `threads`. With VertexCheck::later, the triangles of hierarchies that `meshes` has are
/// looked at while these are measured, which is faster by a walk over the file; where one of them
/// must not be used, false is returned, and `out` and the file have to be read again.
bool add_geometry(RenderScene& out, const Scene& scene, const MeshSource& meshes,
                  const GeometryFilter& filter, VertexCheck vertices, unsigned threads);

/// Appends a body for every kind of vehicle in `out`: its mesh in `scene`, or a plain box if it has
/// none. Bodies cast no shadow where `left_out` has vehicle_shadows.
void add_bodies(RenderScene& out, const Scene& scene, const MeshSource& meshes,
                const PartSet& left_out);

}  // namespace nightcity::scene
