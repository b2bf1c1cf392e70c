// Streams a glTF binary: geometry to a scratch file, one small JSON text an object, joined by finish().
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "formats/atomic_file.h"
#include "formats/draco_codec.h"
#include "formats/error.h"
#include "formats/feature_table.h"
#include "formats/finite.h"
#include "formats/georeference_json.h"
#include "formats/gltf_constants.h"
#include "formats/json_text.h"
#include "formats/scene_file.h"
#include "formats/trs.h"

namespace nightcity {
namespace {

using nlohmann::json;

json vector_json(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}
// glTF allows no 32-bit integers as vertex attributes: ids are floats.
std::vector<float> ids_as_floats(const std::vector<std::uint32_t>& ids, float none) {
  std::vector<float> result(ids.size());
  std::transform(ids.begin(), ids.end(), result.begin(),
                 [none](std::uint32_t id) { return id == no_id ? none : static_cast<float>(id); });
  return result;
}

}  // namespace

struct SceneWriter::State {
  std::filesystem::path path;
  Options options;
  ScratchFile binary;
  FeatureTableWriter features;
  JsonArray materials, meshes, nodes, accessors, views, punctual;
  std::map<std::string, std::size_t> punctual_known;  // equal lights share a description
  std::set<std::string> extensions_used, extensions_required;
  Statistics statistics;
  bool finished = false;

  State(std::filesystem::path target, Options chosen)
      : path(std::move(target)),
        options(chosen),
        binary(path),
        features(path),
        materials(path),
        meshes(path),
        nodes(path),
        accessors(path),
        views(path),
        punctual(path) {}

  [[noreturn]] void fail(const std::string& place, const std::string& message) const {
    throw Error(path.string(), place, message);
  }

  std::size_t add_view(std::uint64_t offset, std::uint64_t size, int target = 0) {
    json view = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}};
    if (target != 0) view["target"] = target;
    return views.add(view);
  }

  template <class T>
  std::size_t write_view(std::span<const T> data, int target = 0) {
    binary.align(4);
    const std::uint64_t offset = binary.size();
    binary.write(data.data(), data.size_bytes());
    return add_view(offset, data.size_bytes(), target);
  }

  static json accessor(int component_type, const char* type, std::size_t count) {
    return {{"componentType", component_type}, {"type", type}, {"count", count}};
  }

  std::size_t add_accessor(json accessor, std::optional<std::size_t> view) {
    if (view) accessor["bufferView"] = *view;
    return accessors.add(accessor);
  }

  void check(const ScenePrimitive& primitive, const std::string& place) const;
  json write_plain(const ScenePrimitive& primitive, std::span<const float> features,
                   std::span<const float> lights);
  json write_draco(const DracoEncoded& encoded);
  json write_primitive(const ScenePrimitive& primitive, const std::string& place);
  json write_instances(const SceneNode& node, const std::vector<Trs>& places);
};

void SceneWriter::State::check(const ScenePrimitive& primitive, const std::string& place) const {
  const std::size_t vertices = primitive.positions.size();
  if (primitive.material >= materials.count())
    fail(place, "material " + std::to_string(primitive.material) + " is not there");
  if (primitive.indices.empty() || primitive.indices.size() % 3 != 0)
    fail(place, "index count is not a multiple of 3 above 0");
  if (vertices >= std::numeric_limits<std::uint32_t>::max()) fail(place, "too many vertices");
  for (const std::uint32_t index : primitive.indices)
    if (index >= vertices)
      fail(place,
           "index " + std::to_string(index) + " of " + std::to_string(vertices) + " vertices");
  for (const glm::vec3& p : primitive.positions)
    if (!finite(p)) fail(place, "position is not finite");
  for (const auto* ids : {&primitive.feature_ids, &primitive.light_ids})
    if (!ids->empty() && ids->size() != vertices) fail(place, "ids do not match the vertices");
  for (const std::uint32_t id : primitive.feature_ids)
    if (id != no_id && id >= features.size())
      fail(place, "feature " + std::to_string(id) + " is not there");
  for (const std::uint32_t id : primitive.light_ids)
    if (id != no_id && id >= gltf::max_id) fail(place, "light id is above 2^23 - 2");
}

json SceneWriter::State::write_plain(const ScenePrimitive& primitive,
                                     std::span<const float> feature_ids,
                                     std::span<const float> light_ids) {
  const std::size_t count = primitive.positions.size();
  glm::vec3 least = primitive.positions[0], greatest = least;
  for (const glm::vec3& p : primitive.positions) {
    least = glm::min(least, p);
    greatest = glm::max(greatest, p);
  }
  json positions = accessor(gltf::float32, "VEC3", count);
  positions["min"] = vector_json(least);
  positions["max"] = vector_json(greatest);
  json attributes = {{"POSITION", add_accessor(positions, write_view(std::span(primitive.positions),
                                                                     gltf::array_buffer))}};
  const auto add_ids = [&](const char* name, std::span<const float> ids) {
    if (!ids.empty())
      attributes[name] = add_accessor(accessor(gltf::float32, "SCALAR", count),
                                      write_view(ids, gltf::array_buffer));
  };
  add_ids(gltf::feature_attribute, feature_ids);
  add_ids(gltf::light_attribute, light_ids);

  // 65535 itself is the restart index: 16 bits serve up to 65535 vertices.
  const std::size_t index_count = primitive.indices.size();
  if (count > 65535) {
    const auto view = write_view(std::span(primitive.indices), gltf::element_array_buffer);
    return {{"attributes", attributes},
            {"indices", add_accessor(accessor(gltf::uint32, "SCALAR", index_count), view)}};
  }
  const std::vector<std::uint16_t> narrow(primitive.indices.begin(), primitive.indices.end());
  const auto view = write_view(std::span(narrow), gltf::element_array_buffer);
  return {{"attributes", attributes},
          {"indices", add_accessor(accessor(gltf::uint16, "SCALAR", index_count), view)}};
}

json SceneWriter::State::write_draco(const DracoEncoded& encoded) {
  extensions_used.insert(gltf::draco);
  extensions_required.insert(gltf::draco);
  statistics.max_draco_bits = std::max(statistics.max_draco_bits, encoded.bits);
  statistics.max_draco_error_m = std::max(statistics.max_draco_error_m, encoded.error_m);
  json positions = accessor(gltf::float32, "VEC3", encoded.vertex_count);
  positions["min"] = vector_json(encoded.least);
  positions["max"] = vector_json(encoded.greatest);
  json attributes = {{"POSITION", add_accessor(positions, {})}},
       draco_ids = {{"POSITION", encoded.position_id}};
  const auto add_ids = [&](const char* name, int id) {
    if (id < 0) return;
    attributes[name] = add_accessor(accessor(gltf::float32, "SCALAR", encoded.vertex_count), {});
    draco_ids[name] = id;
  };
  add_ids(gltf::feature_attribute, encoded.feature_id);
  add_ids(gltf::light_attribute, encoded.light_id);
  const int index_type = encoded.vertex_count > 65535 ? gltf::uint32 : gltf::uint16;
  const std::size_t view = write_view(std::span<const char>(encoded.bytes));
  return {{"attributes", attributes},
          {"indices", add_accessor(accessor(index_type, "SCALAR", encoded.index_count), {})},
          {"extensions", {{gltf::draco, {{"bufferView", view}, {"attributes", draco_ids}}}}}};
}

json SceneWriter::State::write_primitive(const ScenePrimitive& primitive,
                                         const std::string& place) {
  check(primitive, place);
  const auto feature_ids = ids_as_floats(primitive.feature_ids, gltf::null_feature_id);
  const auto light_ids = ids_as_floats(primitive.light_ids, gltf::null_light);
  std::optional<DracoEncoded> encoded;
  if (options.draco)
    encoded = encode_draco(primitive, feature_ids, light_ids, options.draco_tolerance_m);
  json result = encoded ? write_draco(*encoded) : write_plain(primitive, feature_ids, light_ids);
  result["material"] = primitive.material;

  if (!feature_ids.empty()) {
    std::vector<float> unique;  // a feature's vertices mostly stand side by side
    std::unique_copy(feature_ids.begin(), feature_ids.end(), std::back_inserter(unique));
    std::sort(unique.begin(), unique.end());
    unique.erase(std::unique(unique.begin(), unique.end()), unique.end());
    json ids = {{"attribute", 0}, {"propertyTable", 0}};
    const bool has_null = std::binary_search(unique.begin(), unique.end(), gltf::null_feature_id);
    if (has_null) ids["nullFeatureId"] = static_cast<std::uint32_t>(gltf::null_feature_id);
    const std::size_t count = unique.size() - (has_null ? 1 : 0);
    if (count !=
        0) {  // vertices without any feature need no extension, and featureCount must be above 0
      ids["featureCount"] = count;
      result["extensions"][gltf::mesh_features] = {{"featureIds", {ids}}};
      extensions_used.insert(gltf::mesh_features);
    }
  }
  statistics.vertices += primitive.positions.size();
  statistics.triangles += primitive.indices.size() / 3;
  return result;
}

json SceneWriter::State::write_instances(const SceneNode& node, const std::vector<Trs>& places) {
  std::vector<glm::vec3> translations, scales;
  std::vector<glm::vec4> rotations;
  std::vector<std::uint32_t> lights;
  bool rotated = false, scaled = false, lit = false;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Trs& trs = places[i];
    translations.emplace_back(trs.translation);
    rotations.emplace_back(trs.rotation.x, trs.rotation.y, trs.rotation.z, trs.rotation.w);
    scales.emplace_back(trs.scale);
    lights.push_back(node.instances[i].light);
    rotated |= rotations.back() != glm::vec4(0, 0, 0, 1);
    scaled |= scales.back() != glm::vec3(1);
    lit |= lights.back() != no_id;
    if (lights.back() != no_id && lights.back() >= gltf::max_id)
      fail("node " + node.name, "light id is above 2^23 - 2");
  }
  json attributes;
  const auto add = [&](const char* name, const char* type, std::size_t view) {
    attributes[name] = add_accessor(accessor(gltf::float32, type, places.size()), view);
  };
  add("TRANSLATION", "VEC3", write_view(std::span<const glm::vec3>(translations)));
  if (rotated) add("ROTATION", "VEC4", write_view(std::span<const glm::vec4>(rotations)));
  if (scaled) add("SCALE", "VEC3", write_view(std::span<const glm::vec3>(scales)));
  if (lit) {
    const auto values = ids_as_floats(lights, gltf::null_light);
    add(gltf::light_attribute, "SCALAR", write_view(std::span<const float>(values)));
  }
  extensions_used.insert(gltf::gpu_instancing);
  return {{gltf::gpu_instancing, {{"attributes", attributes}}}};
}

SceneWriter::SceneWriter(std::filesystem::path path, Options options)
    : state_(std::make_unique<State>(std::move(path), options)) {
  if (options.draco && !(std::isfinite(options.draco_tolerance_m) && options.draco_tolerance_m > 0))
    throw UsageError(state_->path.string(), "the Draco tolerance is not a positive length");
}

SceneWriter::~SceneWriter() = default;

std::uint32_t SceneWriter::add_material(const SceneMaterial& material) {
  State& s = *state_;
  const glm::vec3 emission = material.emission_cd_m2;
  const float strength = std::max({emission.x, emission.y, emission.z});
  if (!finite(material.base_colour) || !finite(emission) || !std::isfinite(material.roughness) ||
      std::min({emission.x, emission.y, emission.z}) < 0)
    s.fail("material " + material.name, "a value is negative or not finite");
  const glm::dvec3 colour = glm::clamp(glm::dvec3(material.base_colour), 0.0, 1.0);
  json result = {{"pbrMetallicRoughness",
                  {{"baseColorFactor", {colour.x, colour.y, colour.z, 1.0}},
                   {"metallicFactor", 0.0},
                   {"roughnessFactor", std::clamp(material.roughness, 0.0f, 1.0f)}}}};
  if (!material.name.empty()) result["name"] = material.name;
  if (material.double_sided) result["doubleSided"] = true;
  if (strength > 0) {
    // The extension's unit is cd/m2: factor * strength is the emitted luminance of each channel.
    result["emissiveFactor"] = vector_json(glm::dvec3(emission) / double{strength});
    result["extensions"] = {{gltf::emissive_strength, {{"emissiveStrength", strength}}}};
    s.extensions_used.insert(gltf::emissive_strength);
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
    primitives.push_back(s.write_primitive(primitive, place));
  json result = {{"primitives", primitives}};
  if (!mesh.name.empty()) result["name"] = mesh.name;
  ++s.statistics.meshes;
  return static_cast<std::uint32_t>(s.meshes.add(result));
}

void SceneWriter::add_node(const SceneNode& node) {
  State& s = *state_;
  const std::string place = "node " + std::to_string(s.nodes.count()) + " " + node.name;
  if (node.mesh >= s.meshes.count())
    s.fail(place, "mesh " + std::to_string(node.mesh) + " is not there");
  if (node.instances.empty()) return;
  std::vector<Trs> places;
  for (const SceneInstance& instance : node.instances) {
    const auto trs = decompose(glm::dmat4(instance.to_model));
    if (!trs)
      s.fail(place, "instance matrix is not finite, or not translation, rotation and scale");
    places.push_back(*trs);
  }
  json result = {{"mesh", node.mesh}};
  if (!node.name.empty()) result["name"] = node.name;
  json extras;
  if (!node.kind.empty()) extras["kind"] = node.kind;
  if (!node.casts_shadow) extras["casts_shadow"] = false;
  if (node.vehicle != no_id) extras["vehicle"] = node.vehicle;
  if (!extras.is_null()) result["extras"] = {{gltf::extras_key, extras}};
  if (places.size() == 1 && node.instances[0].light == no_id) {
    const Trs& trs = places[0];
    const glm::dquat& r = trs.rotation;
    if (trs.translation != glm::dvec3(0)) result["translation"] = vector_json(trs.translation);
    if (glm::dvec3(r.x, r.y, r.z) != glm::dvec3(0)) result["rotation"] = {r.x, r.y, r.z, r.w};
    if (trs.scale != glm::dvec3(1)) result["scale"] = vector_json(trs.scale);
  } else {
    result["extensions"] = s.write_instances(node, places);
  }
  ++s.statistics.nodes;
  s.statistics.instances += places.size();
  s.nodes.add(result);
}

void SceneWriter::add_punctual(const ScenePunctual& light) {
  State& s = *state_;
  const std::string place = "punctual light " + std::to_string(s.nodes.count());
  const float strongest = std::max({light.colour.x, light.colour.y, light.colour.z});
  const bool spot = light.outer_rad != 0;
  if (!finite(light.position) || !finite(light.direction) || !finite(light.colour) ||
      !(strongest > 0) || std::min({light.colour.x, light.colour.y, light.colour.z}) < 0 ||
      !std::isfinite(light.intensity_cd) || !(light.intensity_cd > 0))
    s.fail(place, "a value is not finite or not positive");
  if (spot &&
      !(light.inner_rad >= 0 && light.inner_rad < light.outer_rad && light.outer_rad < 1.5708))
    s.fail(place, "the cone's angles are out of order");
  // Channels of the extension end at 1: what is above goes into the intensity.
  json description = {{"type", spot ? "spot" : "point"},
                      {"color", vector_json(glm::dvec3(light.colour) / double{strongest})},
                      {"intensity", light.intensity_cd * double{strongest}}};
  if (spot)
    description["spot"] = {{"innerConeAngle", light.inner_rad},
                           {"outerConeAngle", light.outer_rad}};
  const auto [known, is_new] = s.punctual_known.try_emplace(description.dump(), s.punctual.count());
  if (is_new) s.punctual.add(description);
  json node = {{"translation", vector_json(light.position)},
               {"extensions", {{gltf::lights_punctual, {{"light", known->second}}}}}};
  if (spot) {  // a spot shines along its node's -z
    const glm::dvec3 from(0, 0, -1), to = glm::normalize(glm::dvec3(light.direction));
    const double cosine = glm::dot(from, to);
    const glm::dvec3 axis = glm::cross(from, to);
    const glm::dquat r = cosine < -0.999999
                             ? glm::dquat(0, 0, 1, 0)
                             : glm::normalize(glm::dquat(1 + cosine, axis.x, axis.y, axis.z));
    node["rotation"] = {r.x, r.y, r.z, r.w};
  }
  s.extensions_used.insert(gltf::lights_punctual);
  s.nodes.add(node);
}

const SceneWriter::Statistics& SceneWriter::statistics() const {
  return state_->statistics;
}

void SceneWriter::finish(const Georeference& georeference) {
  State& s = *state_;
  if (s.finished) s.fail("", "finish() was called before");
  json extensions = json::object();
  if (s.features.size() != 0) {
    const auto add_view = [&s](std::uint64_t offset, std::uint64_t size) {
      return s.add_view(offset, size);
    };
    extensions[gltf::structural_metadata] = s.features.write(s.binary, add_view);
    s.extensions_used.insert(gltf::structural_metadata);
  }
  s.binary.align(8);

  json extras = georeference_to_json(georeference);
  extras["version"] = gltf::scene_version;
  json asset = {
      {"version", "2.0"}, {"generator", "nightcity"}, {"extras", {{gltf::extras_key, extras}}}};
  std::string copyright;
  for (const std::string& licence : georeference.licences)
    copyright += (copyright.empty() ? "" : "; ") + licence;
  if (!copyright.empty()) asset["copyright"] = copyright;

  JsonText text;
  const auto name = [&text](std::string_view key) {
    text.add(text.size() == 0 ? "{\"" : ",\"");
    text.add(key);
    text.add("\":");
  };
  const auto member = [&](std::string_view key, const json& value) {
    name(key);
    text.add(dump(value));
  };
  const auto array = [&](std::string_view key, JsonArray& elements) {
    if (elements.count() == 0) return;
    name(key);
    text.add(elements);
  };
  member("asset", asset);
  if (!s.extensions_used.empty()) member("extensionsUsed", s.extensions_used);
  if (!s.extensions_required.empty()) member("extensionsRequired", s.extensions_required);
  json scene = json::object();
  for (std::size_t i = 0; i < s.nodes.count(); ++i) scene["nodes"].push_back(i);
  member("scene", 0);
  member("scenes", json::array({scene}));
  array("nodes", s.nodes);
  array("meshes", s.meshes);
  array("materials", s.materials);
  array("accessors", s.accessors);
  array("bufferViews", s.views);
  if (s.binary.size() != 0) member("buffers", json::array({{{"byteLength", s.binary.size()}}}));
  if (!extensions.empty() || s.punctual.count() != 0) {
    name("extensions");
    text.add("{");
    std::string_view before = "\"";
    for (const auto& [key, value] : extensions.items()) {
      for (const std::string_view part : {before, std::string_view(key), std::string_view("\":")})
        text.add(part);
      text.add(dump(value));
      before = ",\"";
    }
    if (s.punctual.count() != 0) {
      for (const std::string_view part :
           {before, std::string_view(gltf::lights_punctual), std::string_view("\":{\"lights\":")})
        text.add(part);
      text.add(s.punctual);
      text.add("}");
    }
    text.add("}");
  }
  text.add("}");
  // The binary chunk starts 28 bytes after the JSON began: keep it on a multiple of 8 for whoever maps the
  // file.
  text.add(std::string((8 - (text.size() + 28) % 8) % 8, ' '));

  const std::uint64_t binary_size = s.binary.size();
  const std::uint64_t total = 12 + 8 + text.size() + (binary_size == 0 ? 0 : 8 + binary_size);
  if (total > std::numeric_limits<std::uint32_t>::max())
    s.fail("", "the scene needs " + std::to_string(total) +
                   " bytes, a .glb holds 4 GiB: use Draco or bake fewer files");
  AtomicFile file(s.path);
  const auto words = [&file](std::initializer_list<std::uint32_t> values) {
    for (const std::uint32_t value : values) file.write(&value, sizeof value);
  };
  words({gltf::glb_magic, 2, static_cast<std::uint32_t>(total)});
  words({static_cast<std::uint32_t>(text.size()), gltf::chunk_json});
  text.write(file);
  if (binary_size != 0) {
    words({static_cast<std::uint32_t>(binary_size), gltf::chunk_binary});
    s.binary.copy_to(file);
  }
  file.commit();
  s.finished = true;
}

}  // namespace nightcity
