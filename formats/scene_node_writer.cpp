// Writes the nodes of a scene: one placement as the node's own, many as instances.
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "formats/gltf_constants.h"
#include "formats/scene_writer_state.h"

namespace nightcity {
namespace {

using gltf::make_accessor;
using nlohmann::json;

json make_extras(const SceneNode& node) {
  json extras;
  if (!node.kind.empty()) extras["kind"] = node.kind;
  if (!node.casts_shadow) extras["casts_shadow"] = false;
  if (node.vehicle != no_id) extras["vehicle"] = node.vehicle;
  return extras;
}

}  // namespace

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
      result["rotation"] = gltf::to_json(rotation);
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

}  // namespace nightcity
