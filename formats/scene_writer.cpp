#include "formats/scene_writer.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include "formats/error.h"
#include "formats/finite.h"
#include "formats/georeference_json.h"
#include "formats/gltf_constants.h"
#include "formats/json_text.h"
#include "formats/scene_places_json.h"
#include "formats/scene_writer_state.h"

namespace nightcity {
namespace {

using nlohmann::json;

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

}  // namespace

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
