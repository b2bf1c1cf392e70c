#include "formats/scene_reader.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <set>

#include "formats/error.h"
#include "formats/feature_table.h"
#include "formats/georeference_json.h"
#include "formats/gltf_accessor.h"
#include "formats/gltf_constants.h"
#include "formats/gltf_document.h"
#include "formats/scene_primitive_reader.h"
#include "formats/trs.h"

namespace nightcity {
namespace {

using gltf::extension;
using gltf::Json;
using gltf::member;

std::string numbered(const char* what, std::size_t number) {
  return what + (" " + std::to_string(number));
}

// Returns a member that is an array of as many numbers as `defaults`, or these if it is absent.
std::vector<double> numbers(const Json& object, const char* key, std::vector<double> defaults) {
  const Json& array = member(object, key);
  if (array.is_null()) return defaults;
  const bool right =
      array.is_array() && array.size() == defaults.size() &&
      std::all_of(array.begin(), array.end(), [](const Json& v) { return v.is_number(); });
  if (!right) throw Error("", key, "is not " + std::to_string(defaults.size()) + " numbers");
  return array.get<std::vector<double>>();
}

class Reader {
 public:
  explicit Reader(const gltf::Document& document)
      : document_(document), accessors_(document), primitives_(accessors_) {}

  Scene read() {
    check_extensions();
    const Json& ours =
        member(member(member(document_.root(), "asset"), "extras"), gltf::extras_key);
    if (ours.is_object()) scene_.georeference = georeference_from_json(ours);
    read_features();
    for (std::size_t i = 0; i < document_.count("materials"); ++i) read_material(i);
    material_count_ = scene_.materials.size();
    for (std::size_t i = 0; i < document_.count("meshes"); ++i) read_mesh(i);
    read_nodes();
    return std::move(scene_);
  }

 private:
  void check_extensions() const;
  void read_features();
  void read_material(std::size_t index);
  void read_mesh(std::size_t index);
  std::uint32_t find_material(const Json& source);
  std::vector<std::size_t> find_roots() const;
  void read_nodes();
  void read_node(const Json& node, const glm::dmat4& to_model);
  std::vector<SceneInstance> read_instances(const Json& node, const glm::dmat4& to_model) const;

  const gltf::Document& document_;
  gltf::AccessorReader accessors_;
  PrimitiveReader primitives_;
  Scene scene_;
  std::vector<FeatureRange> tables_;
  std::size_t material_count_ = 0;  // of the file; a default one may follow
};

// A required extension that we do not know changes the meaning of the data.
void Reader::check_extensions() const {
  static const std::set<std::string> known{gltf::draco,
                                           gltf::emissive_strength,
                                           gltf::gpu_instancing,
                                           gltf::mesh_features,
                                           gltf::structural_metadata,
                                           "EXT_instance_features",
                                           gltf::lights_punctual,
                                           "KHR_materials_unlit",
                                           "KHR_mesh_quantization",
                                           "KHR_texture_transform"};
  for (std::size_t i = 0; i < document_.count("extensionsRequired"); ++i) {
    const Json& name = document_.element("extensionsRequired", i);
    if (!name.is_string() || !known.contains(name.get<std::string>()))
      throw Error("", "extensionsRequired", name.dump() + " is not known to this reader");
  }
}

void Reader::read_features() {
  const Json& metadata = extension(document_.root(), gltf::structural_metadata);
  const ViewBytes view = [this](std::size_t index) { return accessors_.view(index); };
  for (std::size_t t = 0; t < member(metadata, "propertyTables").size(); ++t) {
    const auto features = read_feature_table(metadata, t, view);
    tables_.push_back({scene_.features.size(), features.size()});
    scene_.features.insert(scene_.features.end(), features.begin(), features.end());
  }
}

void Reader::read_material(std::size_t index) {
  const Json& source = document_.element("materials", index);
  const Json& surface = member(source, "pbrMetallicRoughness");
  SceneMaterial result;
  result.name = gltf::text(source, "name");
  const auto colour = numbers(surface, "baseColorFactor", {1, 1, 1, 1});
  const auto emission = numbers(source, "emissiveFactor", {0, 0, 0});
  const double strength =
      gltf::number(extension(source, gltf::emissive_strength), "emissiveStrength", 1);
  result.base_colour = glm::dvec3(colour[0], colour[1], colour[2]);
  result.emission_cd_m2 = glm::dvec3(emission[0], emission[1], emission[2]) * strength;
  result.roughness = static_cast<float>(gltf::number(surface, "roughnessFactor", 1));
  result.double_sided = gltf::boolean(source, "doubleSided", false);
  for (const glm::vec3& v :
       {result.base_colour, result.emission_cd_m2, glm::vec3(result.roughness)})
    for (int i = 0; i < 3; ++i)
      if (!(std::isfinite(v[i]) && v[i] >= 0))
        throw Error("", numbered("material", index), "a value is negative or not finite");
  scene_.materials.push_back(std::move(result));
}

std::uint32_t Reader::find_material(const Json& source) {
  const auto index = gltf::index(source, "material");
  if (index) {
    if (*index >= material_count_) throw Error("", numbered("material", *index), "is not there");
    return static_cast<std::uint32_t>(*index);
  }
  if (scene_.materials.size() == material_count_)  // glTF's default: white, single-sided
    scene_.materials.push_back({.name = "", .base_colour = glm::vec3(1), .double_sided = false});
  return static_cast<std::uint32_t>(material_count_);
}

void Reader::read_mesh(std::size_t index) {
  const Json& source = document_.element("meshes", index);
  const Json& primitives = member(source, "primitives");
  SceneMesh mesh;
  mesh.name = gltf::text(source, "name");
  for (std::size_t p = 0; p < primitives.size(); ++p) {
    try {
      auto primitive = primitives_.read(primitives.at(p), tables_);
      if (!primitive) continue;
      primitive->material = find_material(primitives.at(p));
      if (!primitive->indices.empty()) mesh.primitives.push_back(std::move(*primitive));
    } catch (const Error& error) {
      throw Error("", numbered("mesh", index) + numbered(" primitive", p), error.what());
    }
  }
  scene_.meshes.push_back(std::move(mesh));
}

glm::dmat4 local_matrix(const Json& node) {
  if (node.contains("matrix"))
    return glm::make_mat4(numbers(node, "matrix", std::vector<double>(16)).data());
  const auto r = numbers(node, "rotation", {0, 0, 0, 1});
  Trs trs;
  trs.translation = glm::make_vec3(numbers(node, "translation", {0, 0, 0}).data());
  trs.rotation = glm::dquat(r[3], r[0], r[1], r[2]);
  trs.scale = glm::make_vec3(numbers(node, "scale", {1, 1, 1}).data());
  return compose(trs);
}

glm::mat4 checked(const glm::dmat4& matrix) {
  const glm::mat4 result(matrix);
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(result[c][r])) throw Error("", "transform", "is not finite");
  return result;
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

// Returns the nodes of the default scene. glTF allows a file without scenes: then the nodes without
// a parent.
std::vector<std::size_t> Reader::find_roots() const {
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

void Reader::read_nodes() {
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
      read_node(node, to_model);
      push(node_indices(node, "children"), to_model);
    } catch (const Error& error) {
      throw Error("", numbered("node", step.node), error.what());
    }
  }
}

void Reader::read_node(const Json& node, const glm::dmat4& to_model) {
  const auto mesh = gltf::index(node, "mesh");
  if (!mesh) return;
  if (*mesh >= scene_.meshes.size()) throw Error("", numbered("mesh", *mesh), "is not there");
  const Json& ours = member(member(node, "extras"), gltf::extras_key);
  SceneNode target;
  target.name = gltf::text(node, "name");
  target.kind = gltf::text(ours, "kind");
  target.mesh = static_cast<std::uint32_t>(*mesh);
  target.casts_shadow = gltf::boolean(ours, "casts_shadow", true);
  if (const auto vehicle = gltf::index(ours, "vehicle"))
    target.vehicle = static_cast<std::uint32_t>(*vehicle);
  target.instances = read_instances(node, to_model);
  scene_.nodes.push_back(std::move(target));
}

std::vector<SceneInstance> Reader::read_instances(const Json& node,
                                                  const glm::dmat4& to_model) const {
  const Json& attributes = member(extension(node, gltf::gpu_instancing), "attributes");
  if (!attributes.is_object()) return {{checked(to_model), no_id}};
  const auto read = [&](const char* name, int components) {
    const auto accessor = gltf::index(attributes, name);
    return accessor ? accessors_.floats(*accessor, components) : std::vector<float>();
  };
  const auto translations = read("TRANSLATION", 3), rotations = read("ROTATION", 4),
             scales = read("SCALE", 3);
  const auto lights = to_light_ids(read(gltf::light_attribute, 1));
  const std::size_t count =
      std::max({translations.size() / 3, rotations.size() / 4, scales.size() / 3, lights.size()});
  const auto fits = [count](std::size_t values, std::size_t width) {
    return values == 0 || values == count * width;
  };
  if (!fits(translations.size(), 3) || !fits(rotations.size(), 4) || !fits(scales.size(), 3) ||
      !fits(lights.size(), 1))
    throw Error("", gltf::gpu_instancing, "attributes differ in length");
  std::vector<SceneInstance> instances;
  instances.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Trs trs;
    if (!translations.empty()) trs.translation = glm::make_vec3(&translations[3 * i]);
    if (!rotations.empty()) {
      const float* r = &rotations[4 * i];
      trs.rotation = glm::dquat(r[3], r[0], r[1], r[2]);
    }
    if (!scales.empty()) trs.scale = glm::make_vec3(&scales[3 * i]);
    instances.push_back({checked(to_model * compose(trs)), lights.empty() ? no_id : lights[i]});
  }
  return instances;
}

}  // namespace

Scene read_scene(const std::filesystem::path& path) {
  const gltf::Document document(path);
  try {
    return Reader(document).read();
  } catch (const Error& error) {
    throw Error(path.string(), error.what());
  } catch (const std::bad_alloc&) {
    throw Error(path.string(), "asks for more memory than there is");
  } catch (const Json::exception& error) {
    throw Error(path.string(), error.what());
  }
}

}  // namespace nightcity
