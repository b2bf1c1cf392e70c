// From the meshes of a scene file to triangles, instances and the hierarchies that rays traverse.
#pragma once

#include "runtime/scene/render_scene.h"

namespace nightcity::scene {

/// Appends the meshes of `scene`, their BLASes and instances, and builds the TLAS over these.
/// Triangles without area and instances whose matrix is singular are left out and counted. Vehicles
/// are left out where `out` has traffic.
void add_geometry(RenderScene& out, const Scene& scene);

/// Appends a body for every kind of vehicle in `out`: its mesh in `scene`, or a plain box if it has
/// none.
void add_bodies(RenderScene& out, const Scene& scene);

}  // namespace nightcity::scene
