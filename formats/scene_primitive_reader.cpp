#include "formats/scene_primitive_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <numeric>
#include <string>
#include <utility>

#include "formats/draco_codec.h"
#include "formats/error.h"
#include "formats/finite.h"
#include "formats/gltf_constants.h"

namespace nightcity {
namespace {

using gltf::extension;
using gltf::Json;
using gltf::member;

constexpr std::size_t mode_triangles = 4, mode_fan = 6;  // 5: a strip

// Returns the triangles of a list, strip or fan, three indices each.
std::vector<std::uint32_t> to_triangle_list(std::size_t mode, std::vector<std::uint32_t> indices) {
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

// The table that the feature ids of a primitive refer to.
struct FeatureIds {
  FeatureRange table;
  std::optional<std::size_t> none;
};

// Feature ids have a meaning only through a property table of ours; without one there are none.
std::optional<FeatureIds> find_feature_ids(const Json& source, const char* name,
                                           const std::vector<FeatureRange>& tables) {
  const Json& sets = member(extension(source, name), "featureIds");
  if (!sets.is_array() || sets.empty()) return {};
  const auto table = gltf::index(sets.at(0), "propertyTable"),
             none = gltf::index(sets.at(0), "nullFeatureId");
  if (!table || *table >= tables.size() || tables[*table].count == 0) return {};
  return FeatureIds{tables[*table], none};
}

// Returns colours without their alpha, clamped to [0, 1] as glTF 2.0, section 3.7.2.1, asks for.
std::vector<glm::vec3> to_colours(const std::vector<float>& values, std::size_t components) {
  std::vector<glm::vec3> colours;
  colours.reserve(values.size() / components);
  for (std::size_t i = 0; i + components <= values.size(); i += components) {
    const glm::vec3 colour(values[i], values[i + 1], values[i + 2]);
    if (!finite(colour)) throw Error("", gltf::colour_attribute, "is not finite");
    colours.push_back(glm::clamp(colour, 0.0f, 1.0f));
  }
  return colours;
}

}  // namespace

std::vector<std::uint32_t> to_feature_ids(const Json& source, const char* extension,
                                          const std::vector<float>& values,
                                          const std::vector<FeatureRange>& tables) {
  if (values.empty()) return {};
  const auto features = find_feature_ids(source, extension, tables);
  if (!features) return {};
  const auto [first, count] = features->table;
  std::vector<std::uint32_t> ids(values.size(), no_id);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (features->none && values[i] == static_cast<float>(*features->none)) continue;
    if (!(values[i] >= 0 && values[i] < static_cast<float>(count)))
      throw Error("", gltf::feature_attribute, "id lies outside its property table");
    ids[i] = static_cast<std::uint32_t>(first + static_cast<std::size_t>(values[i]));
  }
  return ids;
}

std::vector<std::uint32_t> to_light_ids(const std::vector<float>& values) {
  std::vector<std::uint32_t> ids(values.size(), no_id);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] < static_cast<float>(gltf::max_id)))
      throw Error("", gltf::light_attribute, "is no light id");
    if (values[i] >= 0) ids[i] = static_cast<std::uint32_t>(values[i]);
  }
  return ids;
}

std::optional<ScenePrimitive> PrimitiveReader::read(const Json& source,
                                                    const std::vector<FeatureRange>& tables,
                                                    std::vector<glm::vec3>& colours) const {
  colours.clear();
  const std::size_t mode = gltf::index(source, "mode").value_or(mode_triangles);
  if (mode > mode_fan) throw Error("", "mode " + std::to_string(mode), "is not known");
  if (mode < mode_triangles) return {};
  // glTF 2.0, section 3.7.2.1: without positions there is nothing to draw.
  if (!gltf::index(member(source, "attributes"), "POSITION")) return {};
  ScenePrimitive primitive;
  const VertexIds ids = read_geometry(source, primitive);
  primitive.indices = to_triangle_list(mode, std::move(primitive.indices));
  primitive.feature_ids = to_feature_ids(source, gltf::mesh_features, ids.features, tables);
  primitive.light_ids = to_light_ids(ids.lights);
  colours = to_colours(ids.colours, ids.colour_components);
  return primitive;
}

std::vector<glm::vec2> PrimitiveReader::read_texture_coordinates(const Json& source,
                                                                 std::uint32_t set,
                                                                 std::size_t vertices) const {
  const std::string name = gltf::texture_attribute(set);
  std::vector<float> values;
  if (const Json& draco = extension(source, gltf::draco); draco.is_object()) {
    const auto id = gltf::index(member(draco, "attributes"), name.c_str());
    const auto view = gltf::index(draco, "bufferView");
    if (!id || !view) return {};
    const std::vector<DracoAttribute> wanted{{static_cast<std::uint32_t>(*id), 2}};
    values = std::move(decode_draco(accessors_.view(*view), wanted).attributes[0]);
  } else if (const auto accessor = gltf::index(member(source, "attributes"), name.c_str())) {
    values = accessors_.floats(*accessor, 2);
  } else {
    return {};
  }
  if (values.size() != 2 * vertices) throw Error("", name, "differs in length from POSITION");
  std::vector<glm::vec2> coordinates(vertices);
  for (std::size_t i = 0; i < vertices; ++i) coordinates[i] = {values[2 * i], values[2 * i + 1]};
  const auto is_finite = [](const glm::vec2& p) {
    return std::isfinite(p.x) && std::isfinite(p.y);
  };
  if (!std::all_of(coordinates.begin(), coordinates.end(), is_finite)) return {};
  return coordinates;
}

std::optional<MappedPrimitive> PrimitiveReader::find(
    const Json& source, const std::vector<FeatureRange>& tables) const {
  const Json& attributes = member(source, "attributes");
  if (gltf::index(source, "mode").value_or(mode_triangles) != mode_triangles ||
      extension(source, gltf::draco).is_object() || gltf::index(attributes, gltf::colour_attribute))
    return {};
  using Place = gltf::AccessorReader::Place;
  MappedPrimitive found;
  bool plain = true;
  const auto take = [&](const Json& object, const char* name, int components, auto is_fit) {
    const auto accessor = gltf::index(object, name);
    if (!accessor) return MappedPrimitive::Array{};
    const std::optional<Place> place = accessors_.find(*accessor, components);
    plain = plain && place && is_fit(*place);
    return plain ? MappedPrimitive::Array{place->first, place->stride} : MappedPrimitive::Array{};
  };
  std::size_t corners = 0;
  found.positions = take(attributes, "POSITION", 3, [&](const Place& place) {
    corners = place.count;
    found.vertices = static_cast<std::uint32_t>(place.count);
    return place.component_type == gltf::float32 && place.count < no_id;
  });
  if (!found.positions.first) return {};
  const auto is_id = [&](const Place& place) {
    return place.component_type == gltf::float32 && place.count == found.vertices;
  };
  const MappedPrimitive::Array ids = take(attributes, gltf::feature_attribute, 1, is_id);
  if (const auto features = find_feature_ids(source, gltf::mesh_features, tables)) {
    found.features = ids;
    found.first_feature = static_cast<std::uint32_t>(features->table.first);
    found.feature_count = static_cast<std::uint32_t>(features->table.count);
    if (features->none) found.null_feature = static_cast<float>(*features->none);
  }
  found.lights = take(attributes, gltf::light_attribute, 1, is_id);
  found.indices = take(source, "indices", 1, [&](const Place& place) {
    corners = place.count;
    found.index_bytes = place.component_type == gltf::uint8    ? 1
                        : place.component_type == gltf::uint16 ? 2
                        : place.component_type == gltf::uint32 ? 4
                                                               : 0;
    return found.index_bytes != 0;
  });
  found.triangles = static_cast<std::uint32_t>(std::min<std::size_t>(corners / 3, no_id));
  plain = plain && corners % 3 == 0;
  return plain && found.triangles > 0 ? std::optional(found) : std::nullopt;
}

std::size_t PrimitiveReader::count_triangles(const Json& source, std::size_t corners) {
  const std::size_t mode = gltf::index(source, "mode").value_or(mode_triangles);
  if (mode < mode_triangles) return 0;
  return mode == mode_triangles ? corners / 3 : corners - std::min<std::size_t>(corners, 2);
}

PrimitiveReader::VertexIds PrimitiveReader::read_geometry(const Json& source,
                                                          ScenePrimitive& target) const {
  const Json& draco = extension(source, gltf::draco);
  std::vector<float> positions;
  VertexIds ids = draco.is_object()
                      ? read_draco(draco, member(source, "attributes"), positions, target.indices)
                      : read_plain(source, positions, target.indices);
  const std::size_t vertices = positions.size() / 3;
  for (const float value : positions)
    if (!std::isfinite(value)) throw Error("", "POSITION", "is not finite");
  for (const std::uint32_t index : target.indices)
    if (index >= vertices)
      throw Error("", "index " + std::to_string(index),
                  "of " + std::to_string(vertices) + " vertices");
  for (const std::size_t count :
       {ids.features.size(), ids.lights.size(), ids.colours.size() / ids.colour_components})
    if (count != 0 && count != vertices) throw Error("", "attributes", "differ in length");
  target.positions.resize(vertices);
  if (vertices != 0)
    std::memcpy(target.positions.data(), positions.data(), vertices * sizeof(glm::vec3));
  return ids;
}

PrimitiveReader::VertexIds PrimitiveReader::read_plain(const Json& source,
                                                       std::vector<float>& positions,
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
  if (const std::size_t components = count_colour_components(attributes)) {
    ids.colour_components = components;
    read(gltf::colour_attribute, static_cast<int>(components), ids.colours);
  }
  if (const auto accessor = gltf::index(source, "indices")) {
    indices = accessors_.indices(*accessor);
  } else {
    indices.resize(positions.size() / 3);
    std::iota(indices.begin(), indices.end(), 0u);
  }
  return ids;
}

std::size_t PrimitiveReader::count_colour_components(const Json& attributes) const {
  const auto accessor = gltf::index(attributes, gltf::colour_attribute);
  if (!accessor) return 0;
  const int components = accessors_.components(*accessor);
  if (components < 3) throw Error("", gltf::colour_attribute, "is neither VEC3 nor VEC4");
  return static_cast<std::size_t>(components);
}

PrimitiveReader::VertexIds PrimitiveReader::read_draco(const Json& draco, const Json& attributes,
                                                       std::vector<float>& positions,
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
  if (const std::size_t components = count_colour_components(attributes)) {
    ids.colour_components = components;
    want(gltf::colour_attribute, static_cast<int>(components), ids.colours);
  }
  const auto view = gltf::index(draco, "bufferView");
  if (!view) throw Error("", gltf::draco, "has no bufferView");
  DracoDecoded decoded = decode_draco(accessors_.view(*view), wanted);
  for (std::size_t i = 0; i < targets.size(); ++i) *targets[i] = std::move(decoded.attributes[i]);
  indices = std::move(decoded.indices);
  return ids;
}

}  // namespace nightcity
