// Any glTF 2.0 into a Scene: ours with its extras, or a stranger's without.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <numeric>
#include <set>

#include "formats/draco_codec.h"
#include "formats/error.h"
#include "formats/feature_table.h"
#include "formats/georeference_json.h"
#include "formats/gltf_accessor.h"
#include "formats/gltf_constants.h"
#include "formats/gltf_document.h"
#include "formats/scene_file.h"
#include "formats/trs.h"

namespace nightcity {
namespace {

using gltf::extension;
using gltf::Json;
using gltf::member;

constexpr std::size_t mode_triangles = 4, mode_fan = 6;  // 5: a strip

std::string numbered(const char* what, std::size_t number) {
  return what + (" " + std::to_string(number));
}

// A member that is an array of `size` numbers, or the defaults where it is absent.
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
  explicit Reader(const gltf::Document& document) : document_(document), accessors_(document) {}

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
  struct VertexIds {
    std::vector<float> features, lights;
  };

  void check_extensions() const;
  void read_features();
  void read_material(std::size_t index);
  void read_mesh(std::size_t index);
  ScenePrimitive read_primitive(const Json& source);
  VertexIds read_geometry(const Json& source, ScenePrimitive& target) const;
  VertexIds read_plain(const Json& source, std::vector<float>& positions,
                       std::vector<std::uint32_t>& indices) const;
  VertexIds read_draco(const Json& draco, std::vector<float>& positions,
                       std::vector<std::uint32_t>& indices) const;
  std::vector<std::uint32_t> feature_ids(const Json& source,
                                         const std::vector<float>& values) const;
  std::uint32_t material(const Json& source);
  std::vector<std::size_t> roots() const;
  void read_nodes();
  void read_node(const Json& node, const glm::dmat4& to_model);
  std::vector<SceneInstance> read_instances(const Json& node, const glm::dmat4& to_model) const;

  const gltf::Document& document_;
  gltf::AccessorReader accessors_;
  Scene scene_;
  std::vector<std::size_t> table_offset_, table_size_;  // of each property table in scene_.features
  std::size_t material_count_ = 0;                      // of the file; a default one may follow
};

// A required extension we do not know changes what the data mean.
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
    table_offset_.push_back(scene_.features.size());
    table_size_.push_back(features.size());
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

std::uint32_t Reader::material(const Json& source) {
  const auto index = gltf::index(source, "material");
  if (index) {
    if (*index >= material_count_) throw Error("", numbered("material", *index), "is not there");
    return static_cast<std::uint32_t>(*index);
  }
  if (scene_.materials.size() == material_count_)  // glTF's default: white and single-sided
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
      ScenePrimitive primitive = read_primitive(primitives.at(p));
      if (!primitive.indices.empty()) mesh.primitives.push_back(std::move(primitive));
    } catch (const Error& error) {
      throw Error("", numbered("mesh", index) + numbered(" primitive", p), error.what());
    }
  }
  scene_.meshes.push_back(std::move(mesh));
}

// Strips and fans become lists.
std::vector<std::uint32_t> triangle_list(std::size_t mode, std::vector<std::uint32_t> indices) {
  if (mode == mode_triangles) {
    indices.resize(indices.size() / 3 * 3);
    return indices;
  }
  std::vector<std::uint32_t> list;
  for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
    if (mode == mode_fan)
      list.insert(list.end(), {indices[i + 1], indices[i + 2], indices[0]});
    else
      list.insert(list.end(), {indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]});
  }
  return list;
}

std::vector<std::uint32_t> light_ids(const std::vector<float>& values) {
  std::vector<std::uint32_t> ids(values.size(), no_id);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] < static_cast<float>(gltf::max_id)))
      throw Error("", gltf::light_attribute, "is no light id");
    if (values[i] >= 0) ids[i] = static_cast<std::uint32_t>(values[i]);
  }
  return ids;
}

ScenePrimitive Reader::read_primitive(const Json& source) {
  ScenePrimitive primitive;
  const std::size_t mode = gltf::index(source, "mode").value_or(mode_triangles);
  if (mode > mode_fan) throw Error("", numbered("mode", mode), "is not known");
  if (mode < mode_triangles) return primitive;  // points and lines have no surface
  const VertexIds ids = read_geometry(source, primitive);
  primitive.indices = triangle_list(mode, std::move(primitive.indices));
  primitive.material = material(source);
  primitive.feature_ids = feature_ids(source, ids.features);
  primitive.light_ids = light_ids(ids.lights);
  return primitive;
}

Reader::VertexIds Reader::read_draco(const Json& draco, std::vector<float>& positions,
                                     std::vector<std::uint32_t>& indices) const {
  const Json& names = member(draco, "attributes");
  VertexIds ids;
  std::vector<DracoAttribute> wanted;
  std::vector<std::vector<float>*> targets;
  const auto want = [&](const char* name, int components, std::vector<float>& values) {
    const auto id = gltf::index(names, name);
    if (!id) return;
    wanted.push_back({static_cast<std::uint32_t>(*id), components});
    targets.push_back(&values);
  };
  want("POSITION", 3, positions);
  want(gltf::feature_attribute, 1, ids.features);
  want(gltf::light_attribute, 1, ids.lights);
  const auto view = gltf::index(draco, "bufferView");
  if (!view) throw Error("", gltf::draco, "has no bufferView");
  DracoDecoded decoded = decode_draco(accessors_.view(*view), wanted);
  for (std::size_t i = 0; i < targets.size(); ++i) *targets[i] = std::move(decoded.attributes[i]);
  indices = std::move(decoded.indices);
  return ids;
}

Reader::VertexIds Reader::read_plain(const Json& source, std::vector<float>& positions,
                                     std::vector<std::uint32_t>& indices) const {
  const Json& attributes = member(source, "attributes");
  VertexIds ids;
  const auto read = [&](const char* name, int components, std::vector<float>& values) {
    if (const auto accessor = gltf::index(attributes, name))
      values = accessors_.floats(*accessor, components);
  };
  read("POSITION", 3, positions);
  read(gltf::feature_attribute, 1, ids.features);
  read(gltf::light_attribute, 1, ids.lights);
  if (const auto accessor = gltf::index(source, "indices")) {
    indices = accessors_.indices(*accessor);
  } else {
    indices.resize(positions.size() / 3);
    std::iota(indices.begin(), indices.end(), 0u);
  }
  return ids;
}

Reader::VertexIds Reader::read_geometry(const Json& source, ScenePrimitive& target) const {
  const Json& draco = extension(source, gltf::draco);
  std::vector<float> positions;
  VertexIds ids = draco.is_object() ? read_draco(draco, positions, target.indices)
                                    : read_plain(source, positions, target.indices);
  const std::size_t vertices = positions.size() / 3;
  for (const float value : positions)
    if (!std::isfinite(value)) throw Error("", "POSITION", "is not finite");
  for (const std::uint32_t index : target.indices)
    if (index >= vertices)
      throw Error("", "index " + std::to_string(index),
                  "of " + std::to_string(vertices) + " vertices");
  for (const auto* values : {&ids.features, &ids.lights})
    if (!values->empty() && values->size() != vertices)
      throw Error("", "attributes", "differ in length");
  target.positions.resize(vertices);
  if (vertices != 0)
    std::memcpy(target.positions.data(), positions.data(), vertices * sizeof(glm::vec3));
  return ids;
}

std::vector<std::uint32_t> Reader::feature_ids(const Json& source,
                                               const std::vector<float>& values) const {
  // Ids mean something only through a property table of ours.
  const Json& sets = member(extension(source, gltf::mesh_features), "featureIds");
  if (values.empty() || !sets.is_array() || sets.empty()) return {};
  const auto table = gltf::index(sets.at(0), "propertyTable"),
             none = gltf::index(sets.at(0), "nullFeatureId");
  if (!table || *table >= table_size_.size() || table_size_[*table] == 0) return {};
  std::vector<std::uint32_t> ids(values.size(), no_id);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (none && values[i] == static_cast<float>(*none)) continue;
    if (!(values[i] >= 0 && values[i] < static_cast<float>(table_size_[*table])))
      throw Error("", gltf::feature_attribute, "id lies outside its property table");
    ids[i] =
        static_cast<std::uint32_t>(table_offset_[*table] + static_cast<std::size_t>(values[i]));
  }
  return ids;
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

// The default scene's, or without any scene (which is allowed) the nodes that are nobody's child.
std::vector<std::size_t> Reader::roots() const {
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
  // A stack of our own: a chain of a million nodes must not end the program. Each node may be reached once.
  struct Step {
    std::size_t node;
    glm::dmat4 parent;
  };
  std::vector<Step> stack;
  const auto push = [&stack](const std::vector<std::size_t>& nodes, const glm::dmat4& parent) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) stack.push_back({*node, parent});
  };
  push(roots(), glm::dmat4(1));
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
  const auto lights = light_ids(read(gltf::light_attribute, 1));
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
