#include "formats/scene_node_reader.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <string>
#include <utility>

#include "formats/error.h"
#include "formats/gltf_constants.h"
#include "formats/gltf_numbers.h"
#include "formats/trs.h"

namespace nightcity {

using gltf::extension;
using gltf::Json;
using gltf::member;
using gltf::numbers;

namespace {

constexpr std::size_t max_instances = 1u << 20;  // that have no place of their own

// glTF asks for quaternions of length 1, and one that is not would scale as well as turn. Those that
// are nearly so stay as they are.
glm::dquat to_rotation(const glm::dquat& q) {
  constexpr double tolerance = 1e-3;
  const double length = glm::length(q);
  return length > 0 && std::abs(length - 1) > tolerance ? q / length : q;
}

glm::dmat4 local_matrix(const Json& node) {
  if (node.contains("matrix"))
    return glm::make_mat4(numbers(node, "matrix", std::vector<double>(16)).data());
  const auto r = numbers(node, "rotation", {0, 0, 0, 1});
  Trs trs;
  trs.translation = glm::make_vec3(numbers(node, "translation", {0, 0, 0}).data());
  trs.rotation = to_rotation(glm::dquat(r[3], r[0], r[1], r[2]));
  trs.scale = glm::make_vec3(numbers(node, "scale", {1, 1, 1}).data());
  return compose(trs);
}

SceneInstance place(const glm::dmat4& matrix, std::uint32_t light, std::uint32_t feature) {
  const glm::mat4 rounded(matrix);
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(rounded[c][r])) throw Error("", "transform", "is not finite");
  return {rounded, light, glm::vec3(glm::dvec3(matrix[3]) - glm::dvec3(rounded[3])), feature};
}

std::vector<std::size_t> node_indices(const Json& object, const char* key) {
  const Json& array = member(object, key);
  std::vector<std::size_t> result;
  for (const Json& element : array) {
    if (!element.is_number_unsigned())
      throw Error("", key, "holds something that is no node index");
    result.push_back(element.get<std::size_t>());
  }
  return result;
}

}  // namespace

// Returns the nodes of the default scene. glTF allows a file without scenes: then the nodes without
// a parent.
std::vector<std::size_t> NodeReader::find_roots() const {
  if (document_.count("scenes") != 0)
    return node_indices(
        document_.element("scenes", gltf::index(document_.root(), "scene").value_or(0)), "nodes");
  const std::size_t count = document_.count("nodes");
  std::vector<bool> is_child(count);
  for (std::size_t i = 0; i < count; ++i)
    for (const std::size_t child : node_indices(document_.element("nodes", i), "children"))
      if (child < count) is_child[child] = true;
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < count; ++i)
    if (!is_child[i]) result.push_back(i);
  return result;
}

std::vector<SceneNode> NodeReader::read() const {
  std::vector<SceneNode> nodes;
  // Recursion would overflow the program's stack on a chain of a million nodes. A node that is
  // reached twice is part of a cycle or of no tree.
  struct Step {
    std::size_t node;
    glm::dmat4 parent;
  };
  std::vector<Step> stack;
  const auto push = [&stack](const std::vector<std::size_t>& nodes, const glm::dmat4& parent) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) stack.push_back({*node, parent});
  };
  push(find_roots(), glm::dmat4(1));
  std::vector<bool> reached(document_.count("nodes"));
  while (!stack.empty()) {
    const Step step = stack.back();
    stack.pop_back();
    const Json& node = document_.element("nodes", step.node);
    try {
      if (reached[step.node]) throw Error("", "is reached twice");
      reached[step.node] = true;
      const glm::dmat4 to_model = step.parent * local_matrix(node);
      if (auto placed = read_node(node, to_model)) {
        placed->number = static_cast<std::uint32_t>(step.node);
        nodes.push_back(std::move(*placed));
      }
      push(node_indices(node, "children"), to_model);
    } catch (const Error& error) {
      throw Error("", numbered("node", step.node), error.what());
    }
  }
  return nodes;
}

std::optional<SceneNode> NodeReader::read_node(const Json& node, const glm::dmat4& to_model) const {
  const auto mesh = gltf::index(node, "mesh");
  if (!mesh) return std::nullopt;
  if (*mesh >= document_.count("meshes")) throw Error("", numbered("mesh", *mesh), "is not there");
  const Json& ours = member(member(node, "extras"), gltf::extras_key);
  SceneNode target;
  target.name = gltf::text(node, "name");
  target.kind = gltf::text(ours, "kind");
  target.mesh = static_cast<std::uint32_t>(*mesh);
  target.casts_shadow = gltf::boolean(ours, "casts_shadow", true);
  if (const auto vehicle = gltf::index(ours, "vehicle"))
    target.vehicle = static_cast<std::uint32_t>(*vehicle);
  target.instances = read_instances(node, to_model);
  return target;
}

std::vector<SceneInstance> NodeReader::read_instances(const Json& node,
                                                      const glm::dmat4& to_model) const {
  const Json& attributes = member(extension(node, gltf::gpu_instancing), "attributes");
  if (!attributes.is_object()) return {place(to_model, no_id, no_id)};
  const auto read = [&](const char* name, int components) {
    const auto accessor = gltf::index(attributes, name);
    return accessor ? accessors_.floats(*accessor, components) : std::vector<float>();
  };
  const auto translations = read("TRANSLATION", 3), rotations = read("ROTATION", 4),
             scales = read("SCALE", 3);
  const auto lights = to_light_ids(read(gltf::light_attribute, 1));
  const auto features =
      to_feature_ids(node, gltf::instance_features, read(gltf::feature_attribute, 1), tables_);
  std::size_t count = std::max({translations.size() / 3, rotations.size() / 4, scales.size() / 3,
                                lights.size(), features.size()});
  // Attributes of others say how many instances there are, and nothing of where.
  for (const Json& attribute : attributes)
    if (count == 0 && attribute.is_number_unsigned())
      count = std::min(
          gltf::index(document_.element("accessors", attribute.get<std::size_t>()), "count")
              .value_or(0),
          max_instances);
  const auto fits = [count](std::size_t values, std::size_t width) {
    return values == 0 || values == count * width;
  };
  if (!fits(translations.size(), 3) || !fits(rotations.size(), 4) || !fits(scales.size(), 3) ||
      !fits(lights.size(), 1) || !fits(features.size(), 1))
    throw Error("", gltf::gpu_instancing, "attributes differ in length");
  std::vector<SceneInstance> instances;
  instances.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Trs trs;
    if (!translations.empty()) trs.translation = glm::make_vec3(&translations[3 * i]);
    if (!rotations.empty()) {
      const float* r = &rotations[4 * i];
      trs.rotation = to_rotation(glm::dquat(r[3], r[0], r[1], r[2]));
    }
    if (!scales.empty()) trs.scale = glm::make_vec3(&scales[3 * i]);
    instances.push_back(place(to_model * compose(trs), lights.empty() ? no_id : lights[i],
                              features.empty() ? no_id : features[i]));
  }
  return instances;
}

}  // namespace nightcity
