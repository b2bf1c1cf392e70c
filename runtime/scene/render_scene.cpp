#include "runtime/scene/render_scene.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <glm/common.hpp>
#include <optional>
#include <system_error>

#include "formats/cancel.h"
#include "formats/error.h"
#include "formats/material_names.h"
#include "formats/night_check.h"
#include "formats/parallel.h"
#include "formats/scene_identity.h"
#include "formats/scene_reader.h"
#include "runtime/scene/local_origin.h"
#include "runtime/scene/parts.h"
#include "runtime/scene/scene_geometry.h"
#include "runtime/scene/scene_traits.h"
#include "runtime/scene/textures.h"

namespace nightcity::scene {
namespace {

// Throws Error for anything unfit: trips, vehicles and their lights go to the device as they are.
void check_traffic(const Traffic& traffic, std::size_t profiles) {
  if (traffic.trips.empty()) return;
  const auto refuse = [](const std::string& what, std::size_t i,
                         const std::optional<std::string>& fault) {
    if (fault) throw Error("traffic", what + " " + std::to_string(i), *fault);
  };
  refuse("cycle", 0, cycle_fault(traffic.cycle));
  for (std::size_t i = 0; i < traffic.vehicles.size(); ++i)
    refuse("vehicle", i, vehicle_fault(traffic.vehicles[i], traffic.vehicle_lights.size()));
  for (std::size_t i = 0; i < traffic.vehicle_lights.size(); ++i)
    refuse("vehicle light", i, vehicle_light_fault(traffic.vehicle_lights[i], profiles));
  for (std::size_t i = 0; i < traffic.trips.size(); ++i)
    refuse("trip", i,
           trip_fault(traffic.trips[i], traffic.cycle, traffic.vehicles.size(), traffic.knots));
}

bool is_usable(const Light& light, std::size_t profiles) {
  for (const glm::vec3& v : {light.position, light.axis, light.tangent})
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return false;
  const std::uint32_t profile = light_profile(light);
  return std::isfinite(light.radius) && std::isfinite(light.half_height) &&
         std::isfinite(light.flux_lm) && light.flux_lm > 0 &&
         (profile == LIGHT_NO_PROFILE || profile < profiles);
}

}  // namespace

namespace {

void add_materials(RenderScene& out, const Scene& scene) {
  for (const SceneMaterial& m : scene.materials) {
    const bool is_pane = m.name == window_pane_material;
    out.materials.push_back({m.base_colour, m.roughness, m.emission_cd_m2, is_pane ? PANE : 0});
    out.carriageways.push_back(is_carriageway_material(m.name));
  }
  if (out.materials.empty()) out.materials.push_back({glm::vec3(0.5f), 1.0f, glm::vec3(0.0f), 0});
  for (const SceneMaterial& m : scene.materials)
    out.parts[static_cast<std::size_t>(Part::textures)] += m.texture.has_value();
  add_textures(out, scene.materials, scene.pictures);
}

void add_lights(RenderScene& out, SceneLights lights) {
  out.profiles = std::move(lights.profiles);
  out.profile_data = std::move(lights.profile_data);
  out.traffic = std::move(lights.traffic);
  check_traffic(out.traffic, out.profiles.size());
  out.lights = std::move(lights.lights);
  out.families = std::move(lights.families);
  out.provenance = std::move(lights.provenance);
  out.families.resize(out.lights.size(), LightFamily::other);
  out.schedules = std::move(lights.schedules);
  out.switches = std::move(lights.switches);
  for (std::size_t i = 0; i < out.schedules.size(); ++i)
    if (const auto fault = schedule_fault(out.schedules[i], out.switches))
      throw Error("schedule " + std::to_string(i), *fault);
  for (Light& light : out.lights) {
    if (is_usable(light, out.profiles.size())) continue;
    // An unfit light keeps its index, because geometry refers to it, but never shines.
    ++out.bad_lights;
    const std::uint32_t id = light.id;
    light = Light{};
    light.axis = {0, -1, 0};
    light.tangent = {1, 0, 0};
    light.kind_profile = pack_kind_profile(LightKind::sphere, LIGHT_NO_PROFILE);
    light.schedule = LIGHT_ALWAYS_ON;
    light.id = id;
  }
}

// Makes all coordinates relative to `origin`.
void set_origin(RenderScene& out, const glm::dvec3& origin) {
  out.origin = origin;
  const auto shift = [&](glm::vec3& p) { p = glm::vec3(glm::dvec3(p) - origin); };
  for (Light& light : out.lights) shift(light.position);
  for (TripKnot& knot : out.traffic.knots) shift(knot.position);
  for (NamedStreet& street : out.places.streets)
    for (auto& line : street.lines)
      for (glm::dvec2& p : line) p -= glm::dvec2(origin.x, origin.z);
  out.georeference.origin = out.georeference.from_model(origin);
}

}  // namespace

RenderScene make_render_scene(const Scene& scene, SceneLights lights, const PartSet& left_out) {
  RenderScene out;
  out.skipped = scene.skipped;
  out.georeference = scene.georeference;
  out.places = scene.places;
  out.parts = count_parts(lights, scene);
  out.left_out = left_out;
  add_materials(out, scene);
  count_materials(out, out.parts);
  const std::vector<std::uint32_t> numbers = leave_out_lights(lights, left_out);
  add_lights(out, std::move(lights));
  const MeshSource meshes = meshes_of(scene);
  set_origin(out, find_local_origin(scene, meshes, out.lights));
  add_bodies(out, scene, meshes, left_out);
  add_geometry(out, scene, meshes, {left_out, numbers}, VertexCheck::now, count_cores());
  leave_out_of_materials(out, left_out);
  return out;
}

namespace {

// Returns how far the farthest corner of a box is from the origin along one axis, m.
float find_reach(const Box& box) {
  const glm::vec3 corner = glm::max(glm::abs(box.lower), glm::abs(box.upper));
  return std::max({corner.x, corner.y, corner.z});
}

std::string kilometres(double metres) {
  return std::to_string(std::lround(metres / 1000)) + " km";
}

// Returns how far apart floats are at a coordinate, in words.
std::string spacing_at(double coordinate) {
  const float at = static_cast<float>(coordinate);
  return std::to_string(std::nextafter(at, 1e38f) - at) + " m";
}

}  // namespace

std::vector<std::string> describe_left_out(const RenderScene& scene) {
  std::vector<std::string> sentences = scene.skipped;
  sentences.insert(sentences.end(), scene.unused_hierarchies.begin(),
                   scene.unused_hierarchies.end());
  const auto say = [&](std::size_t count, const char* one, const char* many, const char* rest) {
    if (count != 0) sentences.push_back(std::to_string(count) + (count == 1 ? one : many) + rest);
  };
  say(scene.dropped_triangles, " triangle is", " triangles are",
      " left out, without area or beyond 1e15 m");
  say(scene.dropped_instances, " instance is", " instances are",
      " left out, beyond 1e15 m or with a matrix that is singular or a millionth of the largest of "
      "its mesh");
  say(scene.bad_lights, " light is", " lights are",
      " switched off: not finite, without flux, or with a profile that is not there");
  const bool is_moved = scene.origin != glm::dvec3(0);
  if (const double reach = double(find_reach(scene.bounds));
      !scene.bounds.empty() && reach > max_reach_m)
    sentences.push_back("reaches " + kilometres(reach) +
                        (is_moved ? " from its middle" : " from its origin") +
                        ", where coordinates are " + spacing_at(reach) +
                        " apart: lights, walls and shadows there are off by as much");
  if (const glm::dvec3 o = glm::abs(scene.origin); is_moved && !scene.lights.empty())
    sentences.push_back("lies " + kilometres(std::max({o.x, o.y, o.z})) +
                        " from the origin of its files, where places of lights are rounded to " +
                        spacing_at(std::max({o.x, o.y, o.z})) +
                        "; bake it with an origin within 20 km ([origin] in the recipe)");
  return sentences;
}

std::string describe_licences(const RenderScene& scene) {
  std::string text;
  for (const std::string& licence : scene.georeference.licences)
    text += (text.empty() ? "" : "; ") + licence;
  return text;
}

namespace {

struct LoadedLights {
  SceneLights lights;
  std::filesystem::path file;  // empty where there is none
  Georeference georeference{};
};

// Returns the lights of the file beside the scene, if there is one.
LoadedLights load_lights(const std::filesystem::path& glb) {
  LoadedLights loaded;
  SceneLights& lights = loaded.lights;
  std::filesystem::path beside = glb;
  beside.replace_extension(".lights");
  // A name that leads nowhere, such as a link to itself, counts as there: reading it says why not.
  const auto is_there = [](const std::filesystem::path& file) {
    std::error_code ignored;
    return std::filesystem::exists(std::filesystem::symlink_status(file, ignored));
  };
  if (!is_there(beside)) beside.replace_extension(".LIGHTS");
  if (!is_there(beside)) return loaded;
  const LightFile file = LightFile::open(beside);
  file.verify();
  loaded.file = beside;
  loaded.georeference = file.georeference();
  lights.lights.assign(file.lights().begin(), file.lights().end());
  lights.provenance.assign(file.provenance().begin(), file.provenance().end());
  lights.families.reserve(file.provenance().size());
  for (const LightProvenance& p : file.provenance())
    lights.families.push_back(static_cast<LightFamily>(p.family));
  lights.profiles.assign(file.profiles().begin(), file.profiles().end());
  lights.profile_data.assign(file.profile_data().begin(), file.profile_data().end());
  lights.schedules.assign(file.schedules().begin(), file.schedules().end());
  lights.switches.assign(file.switches().begin(), file.switches().end());
  const TrafficContent traffic = file.traffic();
  lights.traffic.cycle = traffic.cycle;
  lights.traffic.vehicles.assign(traffic.vehicles.begin(), traffic.vehicles.end());
  lights.traffic.vehicle_lights.assign(traffic.vehicle_lights.begin(),
                                       traffic.vehicle_lights.end());
  lights.traffic.trips.assign(traffic.trips.begin(), traffic.trips.end());
  lights.traffic.knots.assign(traffic.knots.begin(), traffic.knots.end());
  return loaded;
}

}  // namespace

namespace {

// As load_render_scene; nothing where vertices must not be looked at later (add_geometry).
std::optional<RenderScene> try_load(const std::filesystem::path& glb, const PartSet& left_out,
                                    const TakeTraits& take_traits, VertexCheck vertices) {
  RenderScene out;
  std::future<LoadedLights> loading =
      std::async(std::launch::async, [&, token = find_cancel_token()] {
        const CancelScope scope(token);
        return load_lights(glb);
      });
  SceneFile file(glb);
  throw_if_cancelled();
  auto [lights, light_file, georeference] = loading.get();
  if (!light_file.empty())
    require_same_scene(glb, file.scene().georeference, light_file, georeference);
  out.parts = count_parts(lights, file.scene());
  out.left_out = left_out;
  const std::vector<std::uint32_t> numbers = leave_out_lights(lights, left_out);
  add_lights(out, std::move(lights));
  if (take_traits) take_traits(expect_traits(out, file.scene(), file.list_used_materials()));
  MeshSource meshes;
  meshes.read = [&file](std::uint32_t mesh, MappedMesh* mapped) {
    return std::make_shared<const SceneMesh>(file.read_mesh(mesh, mapped));
  };
  meshes.map = [&file](std::uint32_t mesh, VertexCheck check) {
    return file.map_mesh(mesh, check);
  };
  meshes.close = [&] { out.triangles.keep(file.close()); };
  meshes.in_parallel = file.reads_in_parallel();
  meshes.hierarchies = file.hierarchies();
  meshes.triangles.resize(file.mesh_count());
  meshes.bounds.resize(file.mesh_count());
  run_parallel(file.mesh_count(), count_cores(), [&](std::size_t i) {
    meshes.triangles[i] = file.count_triangles(i);
    if (const auto box = file.find_bounds(i)) meshes.bounds[i] = {(*box)[0], (*box)[1]};
  });
  out.georeference = file.scene().georeference;
  out.places = file.scene().places;
  set_origin(out, find_local_origin(file.scene(), meshes, out.lights));
  throw_if_cancelled();
  add_bodies(out, file.scene(), meshes, left_out);
  if (!add_geometry(out, file.scene(), meshes, {left_out, numbers}, vertices, count_cores()))
    return std::nullopt;
  Scene scene = file.finish();
  add_materials(out, scene);
  count_materials(out, out.parts);
  leave_out_of_materials(out, left_out);
  out.skipped = scene.skipped;
  out.features = std::move(scene.features);
  return out;
}

}  // namespace

RenderScene load_render_scene(const std::filesystem::path& glb, const PartSet& left_out,
                              const TakeTraits& take_traits) {
  if (auto scene = try_load(glb, left_out, take_traits, VertexCheck::later))
    return std::move(*scene);
  // The first try has told the traits.
  return std::move(try_load(glb, left_out, {}, VertexCheck::now).value());
}

}  // namespace nightcity::scene
