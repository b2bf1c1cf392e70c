// A scene as the renderer wants it: flat arrays in the shaders' records. Pure CPU; the device copy is
// render's business.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "formats/light_file.h"
#include "formats/scene.h"
#include "runtime/scene/bvh.h"

namespace nightcity {

/// Vehicles as the light file has them, and their bodies.
struct Traffic {
  TrafficCycle cycle{};
  std::vector<VehicleKind> vehicles;
  std::vector<gpu::VehicleBody> bodies;  // parallel to vehicles
  std::vector<Light> vehicle_lights;     // in vehicle frames
  std::vector<Trip> trips;
  std::vector<TripKnot> knots;
};

/// Luminance of the sky by direction, latitude-longitude: row 0 is the zenith, the middle column the north.
/// Empty: none.
struct SkyMap {
  std::uint32_t width = 0, height = 0;
  std::vector<float> rgb;  // cd/m^2, finite, >= 0; 3 * width * height
};

/// Triangles that are placed together.
struct Mesh {
  std::uint32_t root;  // of their hierarchy: as instances and vehicle bodies name the mesh
  std::uint32_t first_triangle, triangles;
};

struct RenderScene {
  std::vector<gpu::BvhNode> nodes;  // every mesh's hierarchy, then the top level's
  std::uint32_t root = BVH_EMPTY;   // of the top level
  std::vector<gpu::Triangle> triangles;
  std::vector<Mesh> meshes{};  // none is empty
  std::vector<gpu::Instance> instances;
  std::vector<gpu::Material> materials;  // at least one
  std::vector<Light> lights;
  std::vector<LightFamily> families;  // parallel to lights
  std::vector<LightProfile> profiles;
  std::vector<float> profile_data;
  std::vector<Schedule> schedules{};
  std::vector<std::uint32_t> switches;  // s since noon
  Traffic traffic;
  SkyMap sky_map;
  Box bounds;  // of everything visible that stands

  std::size_t bad_lights = 0;         // switched off: not finite, no flux, profile out of range
  std::size_t dropped_triangles = 0;  // zero area
  std::size_t dropped_instances = 0;  // singular matrix
};

/// Lights given, or none.
struct SceneLights {
  std::vector<Light> lights;
  std::vector<LightFamily> families;  // empty or parallel to lights
  std::vector<LightProfile> profiles;
  std::vector<float> profile_data;
  std::vector<Schedule> schedules{};
  std::vector<std::uint32_t> switches{};
  Traffic traffic{};  // without bodies: those are the scene's
};

RenderScene make_render_scene(const Scene& scene, SceneLights lights);

/// Reads SCENE.glb and, where it exists, the light file beside it (SCENE.lights). Throws Error.
RenderScene load_render_scene(const std::filesystem::path& glb);

/// Distance along unit `direction` to the nearest triangle of an instance with a bit of `mask`; brute force
/// over all triangles in double, for a few rays (camera placing) and as the oracle of the traversal tests.
std::optional<double> brute_force_hit(const RenderScene& scene, const glm::dvec3& origin,
                                      const glm::dvec3& direction, double t_max,
                                      std::uint32_t mask);

}  // namespace nightcity
