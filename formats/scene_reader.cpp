// Any glTF 2.0 into a Scene: ours with its extras, or a stranger's without.
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "formats/draco_codec.h"
#include "formats/error.h"
#include "formats/feature_table.h"
#include "formats/georeference_json.h"
#include "formats/gltf_accessor.h"
#include "formats/gltf_constants.h"
#include "formats/gltf_load.h"
#include "formats/scene_file.h"
#include "formats/trs.h"

namespace nightcity {
namespace {

using nlohmann::json;
using tinygltf::Value;

const Value no_value;

const Value& member(const Value& object, const char* key) {
  return object.IsObject() && object.Has(key) ? object.Get(key) : no_value;
}
const Value& extension(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found == extensions.end() ? no_value : found->second;
}
int integer(const Value& value, int otherwise) {
  return value.IsNumber() ? value.GetNumberAsInt() : otherwise;
}

// tinygltf's tree as nlohmann's; gltf_load has bounded its depth.
json to_json(const Value& value) {
  if (value.IsBool()) return value.Get<bool>();
  if (value.IsInt()) return value.GetNumberAsInt();
  if (value.IsNumber()) return value.GetNumberAsDouble();
  if (value.IsString()) return value.Get<std::string>();
  if (value.IsArray()) {
    json array = json::array();
    for (std::size_t i = 0; i < value.ArrayLen(); ++i)
      array.push_back(to_json(value.Get(static_cast<int>(i))));
    return array;
  }
  if (value.IsObject()) {
    json object = json::object();
    for (const std::string& key : value.Keys()) object[key] = to_json(value.Get(key));
    return object;
  }
  return nullptr;
}

class Reader {
 public:
  explicit Reader(const tinygltf::Model& model) : model_(model), accessors_(model) {}

  Scene read() {
    check_extensions();
    read_extras();
    read_features();
    for (const auto& material : model_.materials) scene_.materials.push_back(read_material(material));
    for (std::size_t i = 0; i < model_.meshes.size(); ++i) scene_.meshes.push_back(read_mesh(i));
    read_nodes();
    return std::move(scene_);
  }

 private:
  void check_extensions() const;
  void read_extras();
  void read_features();
  SceneMaterial read_material(const tinygltf::Material& material) const;
  SceneMesh read_mesh(std::size_t index);
  void read_geometry(const tinygltf::Primitive& source, ScenePrimitive& target, std::vector<float>& features,
                     std::vector<float>& lights) const;
  std::vector<std::uint32_t> feature_ids(const tinygltf::Primitive& source,
                                         const std::vector<float>& values) const;
  void read_nodes();
  void read_node(std::size_t index, const glm::dmat4& to_model);
  void add_instances(const tinygltf::Node& node, const glm::dmat4& to_model, SceneNode& target) const;
  std::uint32_t default_material();

  const tinygltf::Model& model_;
  gltf::AccessorReader accessors_;
  Scene scene_;
  std::vector<std::size_t> table_offset_, table_size_;  // of each property table in scene_.features
  std::optional<std::uint32_t> default_material_;
};

// A required extension we do not know changes what the data mean.
void Reader::check_extensions() const {
  static const std::set<std::string> known{gltf::draco,
                                           gltf::emissive_strength,
                                           gltf::gpu_instancing,
                                           gltf::mesh_features,
                                           gltf::structural_metadata,
                                           "EXT_instance_features",
                                           "KHR_lights_punctual",
                                           "KHR_materials_unlit",
                                           "KHR_mesh_quantization",
                                           "KHR_texture_transform"};
  for (const std::string& name : model_.extensionsRequired)
    if (!known.contains(name)) throw Error("", "extensionsRequired", name + " is not known to this reader");
}

void Reader::read_extras() {
  const Value& ours = member(model_.asset.extras, gltf::extras_key);
  if (ours.IsObject()) scene_.georeference = georeference_from_json(to_json(ours));
}

void Reader::read_features() {
  const Value& metadata = extension(model_.extensions, gltf::structural_metadata);
  const std::size_t tables = member(metadata, "propertyTables").ArrayLen();
  if (tables == 0) return;
  const json description = to_json(metadata);
  const ViewBytes view = [this](std::int64_t index) { return accessors_.view(index); };
  for (std::size_t t = 0; t < tables; ++t) {
    const auto features = read_feature_table(description, t, view);
    table_offset_.push_back(scene_.features.size());
    table_size_.push_back(features.size());
    scene_.features.insert(scene_.features.end(), features.begin(), features.end());
  }
}

SceneMaterial Reader::read_material(const tinygltf::Material& material) const {
  SceneMaterial result;
  result.name = material.name;
  const auto& colour = material.pbrMetallicRoughness.baseColorFactor;
  const auto& emission = material.emissiveFactor;
  const Value& strength = member(extension(material.extensions, gltf::emissive_strength), "emissiveStrength");
  const double factor = strength.IsNumber() ? strength.GetNumberAsDouble() : 1.0;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    result.base_colour[i] = k < colour.size() ? static_cast<float>(colour[k]) : 1.0f;
    result.emission_cd_m2[i] = k < emission.size() ? static_cast<float>(emission[k] * factor) : 0.0f;
    if (!std::isfinite(result.base_colour[i]) || !std::isfinite(result.emission_cd_m2[i]) ||
        result.base_colour[i] < 0 || result.emission_cd_m2[i] < 0)
      throw Error("", "material " + material.name, "a value is negative or not finite");
  }
  result.roughness = static_cast<float>(material.pbrMetallicRoughness.roughnessFactor);
  if (!std::isfinite(result.roughness))
    throw Error("", "material " + material.name, "roughness is not finite");
  result.double_sided = material.doubleSided;
  return result;
}

// glTF's own default: white, metallic factor aside, single-sided.
std::uint32_t Reader::default_material() {
  if (!default_material_) {
    default_material_ = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back({.name = "", .base_colour = glm::vec3(1), .double_sided = false});
  }
  return *default_material_;
}

// Strips and fans become lists; points and lines have no surface.
std::vector<std::uint32_t> triangle_list(int mode, std::vector<std::uint32_t> indices) {
  if (mode == TINYGLTF_MODE_TRIANGLES || mode == -1) {
    indices.resize(indices.size() / 3 * 3);
    return indices;
  }
  std::vector<std::uint32_t> list;
  for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
      list.insert(list.end(), {indices[i + 1], indices[i + 2], indices[0]});
    else
      list.insert(list.end(), {indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]});
  }
  return list;
}

bool has_surface(int mode) {
  return mode == -1 || mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
         mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

void Reader::read_geometry(const tinygltf::Primitive& source, ScenePrimitive& target,
                           std::vector<float>& features, std::vector<float>& lights) const {
  const auto attribute = [&](const char* name) {
    const auto found = source.attributes.find(name);
    return found == source.attributes.end() ? -1 : found->second;
  };
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;
  if (const Value& draco = extension(source.extensions, gltf::draco); draco.IsObject()) {
    const Value& names = member(draco, "attributes");
    std::vector<DracoAttribute> wanted;
    std::vector<std::vector<float>*> targets;
    const auto want = [&](const char* name, int components, std::vector<float>& values) {
      const int id = integer(member(names, name), -1);
      if (id < 0) return;
      wanted.push_back({static_cast<std::uint32_t>(id), components});
      targets.push_back(&values);
    };
    want("POSITION", 3, positions);
    want(gltf::feature_attribute, 1, features);
    want(gltf::light_attribute, 1, lights);
    DracoDecoded decoded = decode_draco(accessors_.view(integer(member(draco, "bufferView"), -1)), wanted);
    for (std::size_t i = 0; i < targets.size(); ++i) *targets[i] = std::move(decoded.attributes[i]);
    indices = std::move(decoded.indices);
  } else {
    positions = accessors_.floats(attribute("POSITION"), 3);
    if (const int id = attribute(gltf::feature_attribute); id >= 0) features = accessors_.floats(id, 1);
    if (const int id = attribute(gltf::light_attribute); id >= 0) lights = accessors_.floats(id, 1);
    if (source.indices >= 0) {
      indices = accessors_.indices(source.indices);
    } else {
      indices.resize(positions.size() / 3);
      for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::uint32_t>(i);
    }
  }
  const std::size_t vertices = positions.size() / 3;
  for (const float value : positions)
    if (!std::isfinite(value)) throw Error("", "POSITION", "is not finite");
  for (const std::uint32_t index : indices)
    if (index >= vertices)
      throw Error("", "index " + std::to_string(index), "of " + std::to_string(vertices) + " vertices");
  if ((!features.empty() && features.size() != vertices) || (!lights.empty() && lights.size() != vertices))
    throw Error("", "attributes", "differ in length");
  target.positions.resize(vertices);
  std::memcpy(target.positions.data(), positions.data(), vertices * sizeof(glm::vec3));
  target.indices = triangle_list(source.mode, std::move(indices));
}

std::vector<std::uint32_t> Reader::feature_ids(const tinygltf::Primitive& source,
                                               const std::vector<float>& values) const {
  // Ids mean something only through a property table of ours.
  const Value& sets = member(extension(source.extensions, gltf::mesh_features), "featureIds");
  if (values.empty() || sets.ArrayLen() == 0) return {};
  const Value& set = sets.Get(0);
  const int table = integer(member(set, "propertyTable"), -1),
            none = integer(member(set, "nullFeatureId"), -1);
  if (table < 0 || static_cast<std::size_t>(table) >= table_size_.size()) return {};
  const std::size_t offset = table_offset_[static_cast<std::size_t>(table)];
  const std::size_t size = table_size_[static_cast<std::size_t>(table)];
  if (size == 0) return {};
  std::vector<std::uint32_t> ids(values.size(), no_id);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] == static_cast<float>(none)) continue;
    if (!(values[i] >= 0 && values[i] < static_cast<float>(size)))
      throw Error("", gltf::feature_attribute, "id lies outside its property table");
    ids[i] = static_cast<std::uint32_t>(offset + static_cast<std::size_t>(values[i]));
  }
  return ids;
}

std::vector<std::uint32_t> light_ids(const std::vector<float>& values) {
  std::vector<std::uint32_t> ids(values.size(), no_id);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]) || values[i] >= static_cast<float>(gltf::greatest_id))
      throw Error("", gltf::light_attribute, "is no light id");
    if (values[i] >= 0) ids[i] = static_cast<std::uint32_t>(values[i]);
  }
  return ids;
}

SceneMesh Reader::read_mesh(std::size_t index) {
  const tinygltf::Mesh& source = model_.meshes[index];
  SceneMesh mesh;
  mesh.name = source.name;
  for (std::size_t p = 0; p < source.primitives.size(); ++p) {
    const tinygltf::Primitive& primitive = source.primitives[p];
    if (!has_surface(primitive.mode)) continue;
    try {
      ScenePrimitive target;
      std::vector<float> features, lights;
      read_geometry(primitive, target, features, lights);
      if (target.indices.empty()) continue;
      if (primitive.material >= static_cast<int>(model_.materials.size()))
        throw Error("", "material " + std::to_string(primitive.material), "is not there");
      target.material =
          primitive.material < 0 ? default_material() : static_cast<std::uint32_t>(primitive.material);
      target.feature_ids = feature_ids(primitive, features);
      target.light_ids = light_ids(lights);
      mesh.primitives.push_back(std::move(target));
    } catch (const Error& error) {
      throw Error("", "mesh " + std::to_string(index) + " primitive " + std::to_string(p), error.what());
    }
  }
  return mesh;
}

glm::dmat4 local_matrix(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) return glm::make_mat4(node.matrix.data());
  Trs trs;
  if (node.translation.size() == 3) trs.translation = glm::make_vec3(node.translation.data());
  if (node.rotation.size() == 4) {
    const auto& r = node.rotation;
    trs.rotation = glm::dquat(r[3], r[0], r[1], r[2]);
  }
  if (node.scale.size() == 3) trs.scale = glm::make_vec3(node.scale.data());
  return compose(trs);
}

glm::mat4 checked(const glm::dmat4& matrix) {
  const glm::mat4 result(matrix);
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(result[c][r])) throw Error("", "transform", "is not finite");
  return result;
}

void Reader::read_nodes() {
  const std::size_t count = model_.nodes.size();
  std::vector<int> roots;
  if (model_.scenes.empty()) {  // allowed: then everything is shown, from the nodes nobody has as a child
    std::vector<bool> is_child(count);
    for (const auto& node : model_.nodes)
      for (const int child : node.children)
        if (child >= 0 && static_cast<std::size_t>(child) < count)
          is_child[static_cast<std::size_t>(child)] = true;
    for (std::size_t i = 0; i < count; ++i)
      if (!is_child[i]) roots.push_back(static_cast<int>(i));
  } else {
    const int scene = model_.defaultScene < 0 ? 0 : model_.defaultScene;
    if (static_cast<std::size_t>(scene) >= model_.scenes.size())
      throw Error("", "scene " + std::to_string(scene), "is not there");
    roots = model_.scenes[static_cast<std::size_t>(scene)].nodes;
  }
  // A stack of our own: a chain of a million nodes must not end the program. A node may be reached once only.
  struct Step {
    int node;
    glm::dmat4 parent;
  };
  std::vector<Step> stack;
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) stack.push_back({*root, glm::dmat4(1)});
  std::vector<bool> reached(count);
  while (!stack.empty()) {
    const Step step = stack.back();
    stack.pop_back();
    if (step.node < 0 || static_cast<std::size_t>(step.node) >= count)
      throw Error("", "node " + std::to_string(step.node), "is not there");
    const auto index = static_cast<std::size_t>(step.node);
    if (reached[index]) throw Error("", "node " + std::to_string(index), "is reached twice");
    reached[index] = true;
    const glm::dmat4 to_model = step.parent * local_matrix(model_.nodes[index]);
    try {
      read_node(index, to_model);
    } catch (const Error& error) {
      throw Error("", "node " + std::to_string(index), error.what());
    }
    const auto& children = model_.nodes[index].children;
    for (auto child = children.rbegin(); child != children.rend(); ++child)
      stack.push_back({*child, to_model});
  }
}

void Reader::read_node(std::size_t index, const glm::dmat4& to_model) {
  const tinygltf::Node& node = model_.nodes[index];
  if (node.mesh < 0) return;
  if (static_cast<std::size_t>(node.mesh) >= scene_.meshes.size())
    throw Error("", "mesh " + std::to_string(node.mesh), "is not there");
  SceneNode target;
  target.name = node.name;
  target.mesh = static_cast<std::uint32_t>(node.mesh);
  const Value& ours = member(node.extras, gltf::extras_key);
  if (const Value& kind = member(ours, "kind"); kind.IsString()) target.kind = kind.Get<std::string>();
  if (const Value& casts = member(ours, "casts_shadow"); casts.IsBool())
    target.casts_shadow = casts.Get<bool>();
  add_instances(node, to_model, target);
  scene_.nodes.push_back(std::move(target));
}

void Reader::add_instances(const tinygltf::Node& node, const glm::dmat4& to_model, SceneNode& target) const {
  const Value& attributes = member(extension(node.extensions, gltf::gpu_instancing), "attributes");
  if (!attributes.IsObject()) {
    target.instances.push_back({checked(to_model), no_id});
    return;
  }
  const auto read = [&](const char* name, int components) {
    const int accessor = integer(member(attributes, name), -1);
    return accessor < 0 ? std::vector<float>() : accessors_.floats(accessor, components);
  };
  const auto translations = read("TRANSLATION", 3), rotations = read("ROTATION", 4),
             scales = read("SCALE", 3);
  const auto lights = light_ids(read(gltf::light_attribute, 1));
  const std::size_t count =
      std::max({translations.size() / 3, rotations.size() / 4, scales.size() / 3, lights.size()});
  const auto fits = [count](std::size_t values, std::size_t width) {
    return values == 0 || values == count * width;
  };
  if (!fits(translations.size(), 3) || !fits(rotations.size(), 4) || !fits(scales.size(), 3) ||
      !fits(lights.size(), 1))
    throw Error("", gltf::gpu_instancing, "attributes differ in length");
  target.instances.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Trs trs;
    if (!translations.empty()) trs.translation = glm::make_vec3(&translations[3 * i]);
    if (!rotations.empty()) {
      const float* r = &rotations[4 * i];
      trs.rotation = glm::dquat(r[3], r[0], r[1], r[2]);
    }
    if (!scales.empty()) trs.scale = glm::make_vec3(&scales[3 * i]);
    target.instances.push_back({checked(to_model * compose(trs)), lights.empty() ? no_id : lights[i]});
  }
}

}  // namespace

Scene read_scene(const std::filesystem::path& path) {
  const tinygltf::Model model = gltf::load(path);
  try {
    return Reader(model).read();
  } catch (const Error& error) {
    throw Error(path.string(), error.what());
  } catch (const std::bad_alloc&) {
    throw Error(path.string(), "asks for more memory than there is");
  } catch (const std::exception& error) {
    throw Error(path.string(), error.what());
  }
}

}  // namespace nightcity
