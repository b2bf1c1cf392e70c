// A scene in the form that the renderer uploads: flat arrays of the shaders' records.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "formats/georeference.h"
#include "formats/large_vector.h"
#include "formats/light_file.h"
#include "formats/scene.h"
#include "runtime/scene/bvh.h"
#include "runtime/scene/triangle_list.h"
#include "shaders/scene_types.h"

namespace nightcity::scene {

struct SceneTraits;  // scene_traits.h
/// Takes the traits that are expected while a scene is read, on the thread that reads it.
using TakeTraits = std::function<void(const SceneTraits&)>;

/// The traffic of a light file, and the bodies of its vehicles.
struct Traffic {
  TrafficCycle cycle{};
  std::vector<VehicleKind> vehicles;
  std::vector<gpu::VehicleBody> bodies;  // parallel to vehicles
  std::vector<Light> vehicle_lights;     // in vehicle frames
  std::vector<Trip> trips;
  std::vector<TripKnot> knots;
};

/// Luminance of the sky by direction, latitude-longitude: row 0 is the zenith, the middle column
/// the north. Empty if there is no map.
struct SkyMap {
  /// The light that one light of the scene sends upwards.
  struct Share {
    std::uint32_t light;
    glm::vec3 per_lumen;  // lm per channel of each lumen that it emits
  };

  std::uint32_t width = 0, height = 0;
  std::vector<float> rgb;  // cd/m^2, finite, >= 0; 3 * width * height
  // In the glow of a city, all but `natural_cd_m2` is proportional to what these lights send
  // upwards, and the map is that of `upward_lm`, per channel. Empty where the sky follows no
  // lights.
  std::vector<Share> shares{};
  glm::dvec3 upward_lm{0};
  float natural_cd_m2 = 0;  // above the horizon
};

/// The triangles below one BLAS.
struct Mesh {
  std::uint32_t root;  // of the BLAS; instances and vehicle bodies name the mesh by it
  std::uint32_t first_triangle, triangles;
};

/// The parts of a scene that a program can leave out when it loads the scene (parts.h).
enum class Part : std::uint8_t {
  windows,
  traffic,
  profiles,
  aim,
  lamp_sizes,
  schedules,
  lamp_bodies,
  trees,
  vehicle_shadows,
  colours,
  textures,
  water,
};
constexpr std::size_t part_count = 12;
/// A set of parts: bit n is part n.
using PartSet = std::bitset<part_count>;
/// The number of things of each part.
using PartCounts = std::array<std::size_t, part_count>;

/// A scene in a frame of its own: X, Y, Z as in model space, relative to `origin`.
struct RenderScene {
  // The place in model space, m, that all coordinates here are relative to: not 0 where everything
  // lies far from model space's own origin (local_origin.h).
  glm::dvec3 origin{0};
  LargeVector<gpu::BvhNode> nodes;  // every BLAS, then the TLAS
  std::uint32_t root = BVH_EMPTY;   // of the TLAS
  gpu::Horizon horizon{BVH_EMPTY, 0, glm::vec2(1), glm::vec2(0)};  // not in the TLAS
  glm::vec2 boxes_along{1, 0};      // gpu::SceneBuffers::boxes_along
  float boxes_margin_m = 0;         // gpu::SceneBuffers::boxes_margin_m
  TriangleList triangles;
  LargeVector<std::uint32_t> triangle_order;  // which triangle is at each position of the leaves
  std::vector<Mesh> meshes{};                 // none is empty
  std::vector<gpu::Instance> instances;
  std::vector<gpu::Material> materials;  // at least one
  std::vector<bool> carriageways{};      // by material: is_carriageway_material
  std::vector<gpu::Texture> textures{};
  LargeVector<std::uint32_t> texels{};  // of all textures
  LargeVector<Light> lights;
  std::vector<LightFamily> families;  // parallel to lights
  std::vector<LightProfile> profiles;
  std::vector<float> profile_data;
  std::vector<Schedule> schedules{};
  std::vector<std::uint32_t> switches;  // s since noon
  Traffic traffic;
  SkyMap sky_map;
  Box root_box{};                             // of the TLAS, in the frame of its boxes
  Box bounds;                                 // of all static geometry but the horizon
  Georeference georeference{};                // of this frame
  ScenePlaces places{};                       // streets in this frame
  std::vector<SceneFeature> features{};       // city objects, by the triangles' feature
  std::vector<LightProvenance> provenance{};  // parallel to lights, or empty

  std::size_t bad_lights = 0;          // switched off: not finite, no flux, or profile out of range
  std::size_t dropped_triangles = 0;   // zero area, or beyond reach
  std::size_t dropped_instances = 0;   // singular matrix, or beyond reach
  std::vector<std::string> skipped{};  // as in Scene
  std::size_t stored_hierarchies = 0;  // whose order and topology are the file's
  std::vector<std::string> unused_hierarchies{};  // why others of the file were built instead
  PartCounts parts{};  // what the files hold of each part, whether it was left out or not
  PartSet left_out{};
  bool has_edited_lights = false;  // some are not as the files have them
};

/// Returns what the files hold and no picture shows, one sentence for each kind: what the reader
/// skipped, triangles without area, instances without volume, lights that cannot shine. And warns
/// of a scene that is so wide, or whose lights lie so far from the files' origin, that single
/// precision displaces something by more than a millimetre.
std::vector<std::string> describe_left_out(const RenderScene& scene);

/// Returns whose data the scene is made from, under which licences; "" where its files do not say.
/// formats/SPEC.md, section 1: it is to be shown with any picture.
std::string describe_licences(const RenderScene& scene);

/// The lights of a scene.
struct SceneLights {
  LargeVector<Light> lights;
  std::vector<LightFamily> families;  // empty or parallel to lights
  std::vector<LightProfile> profiles;
  std::vector<float> profile_data;
  std::vector<Schedule> schedules{};
  std::vector<std::uint32_t> switches{};
  std::vector<LightProvenance> provenance{};  // empty or parallel to lights
  Traffic traffic{};                          // without bodies: those are the scene's
};

/// Builds the hierarchies and checks lights and traffic. Throws Error for unfit traffic or
/// schedules; unfit lights are counted and never shine. Leaves out the parts in `left_out`.
RenderScene make_render_scene(const Scene& scene, SceneLights lights, const PartSet& left_out = {});

/// Reads SCENE.glb and, if it exists, the light file beside it (SCENE.lights), without the parts in
/// `left_out`. Throws Error; Cancelled where the thread's token asks for an end (formats/cancel.h).
/// `take_traits`: gets the expected traits before the geometry is read; null = nobody asks.
RenderScene load_render_scene(const std::filesystem::path& glb, const PartSet& left_out = {},
                              const TakeTraits& take_traits = {});

}  // namespace nightcity::scene
