#include "formats/scene_writer.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "formats/error.h"
#include "formats/feature_table.h"
#include "formats/finite.h"
#include "formats/georeference_json.h"
#include "formats/gltf_constants.h"
#include "formats/gltf_stream.h"
#include "formats/json_text.h"
#include "formats/scene_places_json.h"
#include "formats/scene_primitive_writer.h"
#include "formats/trs.h"

namespace nightcity {
namespace {

using gltf::make_accessor;
using nlohmann::json;

float min_of(const glm::vec3& v) {
  return std::min({v.x, v.y, v.z});
}
float max_of(const glm::vec3& v) {
  return std::max({v.x, v.y, v.z});
}

json to_json(const glm::dquat& rotation) {
  return {rotation.x, rotation.y, rotation.z, rotation.w};
}

// Returns the rotation that turns -z, along which a spot of KHR_lights_punctual shines, to
// `direction`.
glm::dquat turn_spot_to(const glm::dvec3& direction) {
  const glm::dvec3 from(0, 0, -1), to = glm::normalize(direction);
  const double cosine = glm::dot(from, to);
  if (cosine < -0.999999) return {0, 0, 1, 0};  // half a turn: the cross product below vanishes
  const glm::dvec3 axis = glm::cross(from, to);
  return glm::normalize(glm::dquat(1 + cosine, axis.x, axis.y, axis.z));
}

json make_asset(const Georeference& georeference, const ScenePlaces& places) {
  json extras = georeference_to_json(georeference);
  add_to_json(places, extras);
  extras["version"] = gltf::scene_version;
  json asset = {
      {"version", "2.0"}, {"generator", "nightcity"}, {"extras", {{gltf::extras_key, extras}}}};
  std::string copyright;
  for (const std::string& licence : georeference.licences)
    copyright += (copyright.empty() ? "" : "; ") + licence;
  if (!copyright.empty()) asset["copyright"] = copyright;
  return asset;
}

json make_extras(const SceneNode& node) {
  json extras;
  if (!node.kind.empty()) extras["kind"] = node.kind;
  if (!node.casts_shadow) extras["casts_shadow"] = false;
  if (node.vehicle != no_id) extras["vehicle"] = node.vehicle;
  return extras;
}

}  // namespace

struct SceneWriter::State {
  std::filesystem::path path;
  Statistics statistics;
  gltf::Stream stream;
  PrimitiveWriter primitives;
  FeatureTableWriter features;
  JsonArray materials, meshes, nodes, punctual, ies, images, samplers, textures;
  std::map<std::string, std::size_t> known_punctual;  // equal lights share a description
  std::map<std::string, std::size_t> known_samplers, known_textures;
  bool finished = false;

  State(std::filesystem::path target, Options options)
      : path(std::move(target)),
        stream(path),
        primitives(path, stream, statistics,
                   options.draco ? std::optional(options.draco_tolerance_m) : std::nullopt),
        features(path),
        materials(path),
        meshes(path),
        nodes(path),
        punctual(path),
        ies(path),
        images(path),
        samplers(path),
        textures(path) {}

  [[noreturn]] void fail(const std::string& place, const std::string& message) const {
    throw Error(path.string(), place, message);
  }

  void check(const ScenePunctual& light) const;
  std::vector<Trs> find_placements(const SceneNode& node) const;
  json write_instances(const SceneNode& node, const std::vector<Trs>& placements);
  std::size_t write_light_description(const ScenePunctual& light);
  json describe_texture(const SceneTexture& texture, const std::string& place);
  json write_features();
  void write_root(JsonText& text, const json& asset, const json& feature_table);
};

SceneWriter::SceneWriter(std::filesystem::path path, Options options)
    : state_(std::make_unique<State>(std::move(path), options)) {
  if (options.draco && !(std::isfinite(options.draco_tolerance_m) && options.draco_tolerance_m > 0))
    throw UsageError(state_->path.string(), "the Draco tolerance is not a positive length");
}

SceneWriter::~SceneWriter() = default;

const SceneWriter::Statistics& SceneWriter::statistics() const {
  return state_->statistics;
}

std::uint32_t SceneWriter::add_picture(std::span<const std::byte> bytes) {
  State& s = *state_;
  if (bytes.empty()) s.fail("image " + std::to_string(s.images.count()), "is empty");
  const bool is_png = bytes[0] == std::byte{0x89};
  const std::size_t view = s.stream.write_view(bytes);
  return static_cast<std::uint32_t>(
      s.images.add({{"bufferView", view}, {"mimeType", is_png ? "image/png" : "image/jpeg"}}));
}

// Returns the textureInfo; equal textures and samplers are written once.
json SceneWriter::State::describe_texture(const SceneTexture& texture, const std::string& place) {
  if (texture.picture >= images.count())
    fail(place, "picture " + std::to_string(texture.picture) + " is not there");
  const auto add = [](std::map<std::string, std::size_t>& known, JsonArray& array,
                      const json& description) {
    const auto [at, is_new] = known.try_emplace(description.dump(), array.count());
    if (is_new) array.add(description);
    return at->second;
  };
  const std::size_t sampler = add(known_samplers, samplers,
                                  {{"magFilter", gltf::linear},
                                   {"minFilter", gltf::linear_mipmap_linear},
                                   {"wrapS", gltf::to_wrap(texture.wrap_u)},
                                   {"wrapT", gltf::to_wrap(texture.wrap_v)}});
  return {{"index",
           add(known_textures, textures, {{"sampler", sampler}, {"source", texture.picture}})}};
}

std::uint32_t SceneWriter::add_material(const SceneMaterial& material) {
  State& s = *state_;
  const glm::vec3 emission = material.emission_cd_m2;
  if (!finite(material.base_colour) || !finite(emission) || !std::isfinite(material.roughness) ||
      min_of(emission) < 0)
    s.fail("material " + material.name, "a value is negative or not finite");
  const glm::vec3 factor = material.texture ? material.texture->factor : material.base_colour;
  if (!finite(factor)) s.fail("material " + material.name, "a factor is not finite");
  const glm::dvec3 colour = glm::clamp(glm::dvec3(factor), 0.0, 1.0);
  json result = {{"pbrMetallicRoughness",
                  {{"baseColorFactor", {colour.x, colour.y, colour.z, 1.0}},
                   {"metallicFactor", 0.0},
                   {"roughnessFactor", std::clamp(material.roughness, 0.0f, 1.0f)}}}};
  if (material.texture)
    result["pbrMetallicRoughness"]["baseColorTexture"] =
        s.describe_texture(*material.texture, "material " + material.name);
  if (!material.name.empty()) result["name"] = material.name;
  if (material.double_sided) result["doubleSided"] = true;
  if (const float strength = max_of(emission); strength > 0) {
    // The unit of the extension is cd/m2: factor * strength is the emitted luminance of each
    // channel.
    result["emissiveFactor"] = gltf::to_json(glm::dvec3(emission) / double{strength});
    result["extensions"] = {{gltf::emissive_strength, {{"emissiveStrength", strength}}}};
    s.stream.extensions_used.insert(gltf::emissive_strength);
  }
  return static_cast<std::uint32_t>(s.materials.add(result));
}

std::uint32_t SceneWriter::add_feature(const SceneFeature& feature) {
  ++state_->statistics.features;
  return state_->features.add(feature);
}

std::uint32_t SceneWriter::add_mesh(const SceneMesh& mesh) {
  State& s = *state_;
  const std::string place = "mesh " + std::to_string(s.meshes.count()) + " " + mesh.name;
  if (mesh.primitives.empty()) s.fail(place, "has no triangles");
  json primitives = json::array();
  for (const ScenePrimitive& primitive : mesh.primitives)
    primitives.push_back(
        s.primitives.write(primitive, {s.materials.count(), s.features.size()}, place));
  json result = {{"primitives", primitives}};
  if (!mesh.name.empty()) result["name"] = mesh.name;
  ++s.statistics.meshes;
  return static_cast<std::uint32_t>(s.meshes.add(result));
}

void SceneWriter::add_node(const SceneNode& node) {
  State& s = *state_;
  if (node.mesh >= s.meshes.count())
    s.fail("node " + std::to_string(s.nodes.count()) + " " + node.name,
           "mesh " + std::to_string(node.mesh) + " is not there");
  if (node.instances.empty()) return;
  const std::vector<Trs> placements = s.find_placements(node);
  json result = {{"mesh", node.mesh}};
  if (!node.name.empty()) result["name"] = node.name;
  if (const json extras = make_extras(node); !extras.is_null())
    result["extras"] = {{gltf::extras_key, extras}};
  if (placements.size() == 1 && node.instances[0].light == no_id &&
      node.instances[0].feature == no_id) {
    const auto& [translation, rotation, scale] = placements[0];
    if (translation != glm::dvec3(0)) result["translation"] = gltf::to_json(translation);
    if (glm::dvec3(rotation.x, rotation.y, rotation.z) != glm::dvec3(0))
      result["rotation"] = to_json(rotation);
    if (scale != glm::dvec3(1)) result["scale"] = gltf::to_json(scale);
  } else {
    result["extensions"] = s.write_instances(node, placements);
  }
  ++s.statistics.nodes;
  s.statistics.instances += placements.size();
  s.nodes.add(result);
}

std::vector<Trs> SceneWriter::State::find_placements(const SceneNode& node) const {
  std::vector<Trs> placements;
  placements.reserve(node.instances.size());
  for (const SceneInstance& instance : node.instances) {
    const auto trs = decompose(to_double(instance));
    if (!trs)
      fail("node " + std::to_string(nodes.count()) + " " + node.name,
           "instance matrix is not finite, or not translation, rotation and scale");
    placements.push_back(*trs);
  }
  return placements;
}

// Returns the extensions of a node with many instances. Attributes that are the default of all are
// not written.
json SceneWriter::State::write_instances(const SceneNode& node,
                                         const std::vector<Trs>& placements) {
  std::vector<glm::vec3> translations, scales;
  std::vector<glm::vec4> rotations;
  std::vector<std::uint32_t> lights, features;
  bool is_rotated = false, is_scaled = false, is_lit = false;
  for (std::size_t i = 0; i < placements.size(); ++i) {
    const Trs& trs = placements[i];
    translations.emplace_back(trs.translation);
    rotations.emplace_back(trs.rotation.x, trs.rotation.y, trs.rotation.z, trs.rotation.w);
    scales.emplace_back(trs.scale);
    lights.push_back(node.instances[i].light);
    features.push_back(node.instances[i].feature);
    if (features.back() != no_id && features.back() >= this->features.size())
      fail("node " + node.name, "feature " + std::to_string(features.back()) + " is not there");
    is_rotated |= rotations.back() != glm::vec4(0, 0, 0, 1);
    is_scaled |= scales.back() != glm::vec3(1);
    is_lit |= lights.back() != no_id;
    if (lights.back() != no_id && lights.back() >= gltf::max_id)
      fail("node " + node.name, "light id is above 2^23 - 2");
  }
  json attributes;
  const auto add = [&](const char* name, const char* type, std::size_t view) {
    attributes[name] =
        stream.add_accessor(make_accessor(gltf::float32, type, placements.size()), view);
  };
  add("TRANSLATION", "VEC3", stream.write_view(std::span<const glm::vec3>(translations)));
  if (is_rotated) add("ROTATION", "VEC4", stream.write_view(std::span<const glm::vec4>(rotations)));
  if (is_scaled) add("SCALE", "VEC3", stream.write_view(std::span<const glm::vec3>(scales)));
  if (is_lit) {
    const auto ids = to_float_ids(lights, gltf::null_light);
    add(gltf::light_attribute, "SCALAR", stream.write_view(std::span<const float>(ids)));
  }
  json extensions;
  const auto feature_ids = to_float_ids(features, gltf::null_feature_id);
  if (const json ids = describe_feature_ids(feature_ids); !ids.is_null()) {
    add(gltf::feature_attribute, "SCALAR", stream.write_view(std::span<const float>(feature_ids)));
    extensions[gltf::instance_features] = {{"featureIds", ids}};
    stream.extensions_used.insert(gltf::instance_features);
  }
  stream.extensions_used.insert(gltf::gpu_instancing);
  extensions[gltf::gpu_instancing] = {{"attributes", attributes}};
  return extensions;
}

void SceneWriter::add_punctual(const ScenePunctual& light) {
  State& s = *state_;
  s.check(light);
  json node = {
      {"translation", gltf::to_json(light.position)},
      {"extensions", {{gltf::lights_punctual, {{"light", s.write_light_description(light)}}}}}};
  if (light.outer_rad != 0) node["rotation"] = to_json(turn_spot_to(light.direction));
  s.stream.extensions_used.insert(gltf::lights_punctual);
  s.nodes.add(node);
}

void SceneWriter::State::check(const ScenePunctual& light) const {
  const std::string place = "punctual light " + std::to_string(nodes.count());
  if (!finite(light.position) || !finite(light.direction) || !finite(light.colour) ||
      !(max_of(light.colour) > 0) || min_of(light.colour) < 0 ||
      !std::isfinite(light.intensity_cd) || !(light.intensity_cd > 0))
    fail(place, "a value is not finite or not positive");
  constexpr double max_cone = 1.5708;  // pi / 2 and what rounding may add to it
  if (light.outer_rad != 0 &&
      !(light.inner_rad >= 0 && light.inner_rad < light.outer_rad && light.outer_rad < max_cone))
    fail(place, "the cone's angles are out of order");
}

std::size_t SceneWriter::State::write_light_description(const ScenePunctual& light) {
  const bool is_spot = light.outer_rad != 0;
  // The extension's colour channels end at 1, so a stronger channel scales the intensity.
  const double strongest = max_of(light.colour);
  json description = {{"type", is_spot ? "spot" : "point"},
                      {"color", gltf::to_json(glm::dvec3(light.colour) / strongest)},
                      {"intensity", light.intensity_cd * strongest}};
  if (is_spot)
    description["spot"] = {{"innerConeAngle", light.inner_rad},
                           {"outerConeAngle", light.outer_rad}};
  const auto [known, is_new] = known_punctual.try_emplace(description.dump(), punctual.count());
  if (is_new) punctual.add(description);
  return known->second;
}

std::uint32_t SceneWriter::add_ies_profile(std::string_view text) {
  State& s = *state_;
  const std::size_t view = s.stream.write_view(std::span<const char>(text));
  return static_cast<std::uint32_t>(
      s.ies.add({{"bufferView", view}, {"mimeType", "application/x-ies-lm-63"}}));
}

void SceneWriter::add_ies_light(const SceneIesLight& light) {
  State& s = *state_;
  const std::string place = "light " + std::to_string(s.nodes.count());
  if (light.profile >= s.ies.count()) s.fail(place, "its profile is not there");
  const double strongest = max_of(light.colour);
  if (!finite(light.position) || !finite(light.axis) || !finite(light.tangent) ||
      !finite(light.colour) || min_of(light.colour) < 0 || !(strongest > 0) ||
      !std::isfinite(light.multiplier) || !(light.multiplier > 0))
    s.fail(place, "a value is not finite or not positive");
  // The extension aims a light along -z, and has C = 0 towards x.
  const glm::dvec3 x = glm::normalize(glm::dvec3(light.tangent)),
                   z = -glm::normalize(glm::dvec3(light.axis));
  const glm::dquat rotation(glm::dmat3(x, glm::cross(z, x), z));
  s.nodes.add({{"translation", gltf::to_json(light.position)},
               {"rotation", to_json(glm::normalize(rotation))},
               {"extensions",
                {{gltf::lights_ies,
                  {{"light", light.profile},
                   {"multiplier", light.multiplier * strongest},
                   {"color", gltf::to_json(glm::dvec3(light.colour) / strongest)}}}}}});
  s.stream.extensions_used.insert(gltf::lights_ies);
}

void SceneWriter::finish(const Georeference& georeference, const ScenePlaces& places) {
  State& s = *state_;
  if (s.finished) s.fail("", "finish() was called before");
  const json feature_table = s.write_features();
  s.stream.binary.align(8);
  JsonText text;
  try {
    s.write_root(text, make_asset(georeference, places), feature_table);
  } catch (const Error& error) {
    s.fail("", error.what());
  }
  gltf::write_glb(s.path, text, s.stream.binary);
  s.finished = true;
}

// Returns the extension EXT_structural_metadata, null without features.
json SceneWriter::State::write_features() {
  if (features.size() == 0) return {};
  stream.extensions_used.insert(gltf::structural_metadata);
  return features.write(stream.binary, [this](std::uint64_t offset, std::uint64_t size) {
    return stream.add_view(offset, size);
  });
}

void SceneWriter::State::write_root(JsonText& text, const json& asset, const json& feature_table) {
  json scene = json::object();
  for (std::size_t i = 0; i < nodes.count(); ++i) scene["nodes"].push_back(i);

  JsonObject root(text);
  const auto add_array = [&root](std::string_view key, JsonArray& elements) {
    if (elements.count() != 0) root.add(key, elements);  // glTF allows no empty arrays here
  };
  root.add("asset", asset);
  if (!stream.extensions_used.empty()) root.add("extensionsUsed", stream.extensions_used);
  if (!stream.extensions_required.empty())
    root.add("extensionsRequired", stream.extensions_required);
  root.add("scene", 0);
  root.add("scenes", json::array({scene}));
  add_array("nodes", nodes);
  add_array("meshes", meshes);
  add_array("materials", materials);
  add_array("textures", textures);
  add_array("images", images);
  add_array("samplers", samplers);
  add_array("accessors", stream.accessors);
  add_array("bufferViews", stream.views);
  if (stream.binary.size() != 0)
    root.add("buffers", json::array({{{"byteLength", stream.binary.size()}}}));
  if (!feature_table.is_null() || punctual.count() != 0 || ies.count() != 0) {
    JsonObject extensions = root.add_object("extensions");
    if (!feature_table.is_null()) extensions.add(gltf::structural_metadata, feature_table);
    if (punctual.count() != 0) {
      JsonObject lights = extensions.add_object(gltf::lights_punctual);
      lights.add("lights", punctual);
      lights.end();
    }
    if (ies.count() != 0) {
      JsonObject lights = extensions.add_object(gltf::lights_ies);
      lights.add("lights", ies);
      lights.end();
    }
    extensions.end();
  }
  root.end();
}

}  // namespace nightcity
