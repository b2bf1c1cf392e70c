#include "formats/scene_primitive_writer.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <iterator>
#include <limits>

#include "formats/error.h"
#include "formats/gltf_constants.h"

namespace nightcity {
namespace {

using gltf::make_accessor;
using nlohmann::json;

// Index 65535 restarts a strip in 16 bits, so these serve up to this many vertices.
constexpr std::size_t max_vertices_of_16_bits = 65535;

json make_position_accessor(std::size_t count, const glm::vec3& min, const glm::vec3& max) {
  json accessor = make_accessor(gltf::float32, "VEC3", count);
  accessor["min"] = gltf::to_json(min);
  accessor["max"] = gltf::to_json(max);
  return accessor;
}

// Returns whether floats are 2 mm apart and more at some of the vertices, which Draco's rounding
// adds to the tolerance. Such a mesh is the ground to the horizon: few triangles.
bool is_wide(const ScenePrimitive& primitive) {
  constexpr float widest_m = 20'000;
  return std::any_of(primitive.positions.begin(), primitive.positions.end(),
                     [](const glm::vec3& p) {
                       return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > widest_m;
                     });
}

}  // namespace

std::vector<float> to_float_ids(const std::vector<std::uint32_t>& ids, float none) {
  std::vector<float> result(ids.size());
  std::transform(ids.begin(), ids.end(), result.begin(),
                 [none](std::uint32_t id) { return id == no_id ? none : static_cast<float>(id); });
  return result;
}

json describe_feature_ids(std::span<const float> feature_ids) {
  std::vector<float> unique;
  // The vertices of a feature mostly follow each other: dropping repetitions first leaves little to
  // sort.
  std::unique_copy(feature_ids.begin(), feature_ids.end(), std::back_inserter(unique));
  std::sort(unique.begin(), unique.end());
  unique.erase(std::unique(unique.begin(), unique.end()), unique.end());
  const bool has_null = std::binary_search(unique.begin(), unique.end(), gltf::null_feature_id);
  const std::size_t count = unique.size() - (has_null ? 1 : 0);
  if (count == 0) return {};
  json ids = {{"attribute", 0}, {"propertyTable", 0}, {"featureCount", count}};
  if (has_null) ids["nullFeatureId"] = static_cast<std::uint32_t>(gltf::null_feature_id);
  return json::array({ids});
}

PrimitiveWriter::PrimitiveWriter(std::filesystem::path file, gltf::Stream& stream,
                                 SceneStatistics& statistics,
                                 std::optional<double> draco_tolerance_m)
    : file_(std::move(file)),
      stream_(stream),
      statistics_(statistics),
      draco_tolerance_m_(draco_tolerance_m) {}

json PrimitiveWriter::write(const ScenePrimitive& primitive, const Limits& limits,
                            const std::string& place) {
  check(primitive, limits, place);
  const auto feature_ids = to_float_ids(primitive.feature_ids, gltf::null_feature_id);
  const auto light_ids = to_float_ids(primitive.light_ids, gltf::null_light);
  std::optional<DracoEncoded> encoded;
  if (draco_tolerance_m_ && !is_wide(primitive) && primitive.texture_coordinates.empty())
    encoded = encode_draco(primitive, feature_ids, light_ids, *draco_tolerance_m_);
  json result = encoded ? write_draco(*encoded) : write_plain(primitive, feature_ids, light_ids);
  result["material"] = primitive.material;
  if (const json features = describe_feature_ids(feature_ids); !features.is_null()) {
    result["extensions"][gltf::mesh_features] = {{"featureIds", features}};
    stream_.extensions_used.insert(gltf::mesh_features);
  }
  statistics_.vertices += primitive.positions.size();
  statistics_.triangles += primitive.indices.size() / 3;
  return result;
}

void PrimitiveWriter::check(const ScenePrimitive& primitive, const Limits& limits,
                            const std::string& place) const {
  const auto fail = [&](const std::string& message) {
    throw Error(file_.string(), place, message);
  };
  const std::size_t vertices = primitive.positions.size();
  if (primitive.material >= limits.materials)
    fail("material " + std::to_string(primitive.material) + " is not there");
  if (primitive.indices.empty() || primitive.indices.size() % 3 != 0)
    fail("index count is not a multiple of 3 above 0");
  if (vertices >= std::numeric_limits<std::uint32_t>::max()) fail("too many vertices");
  for (const std::uint32_t index : primitive.indices)
    if (index >= vertices)
      fail("index " + std::to_string(index) + " of " + std::to_string(vertices) + " vertices");
  for (const glm::vec3& p : primitive.positions)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      fail("position is not finite");
  for (const auto* ids : {&primitive.feature_ids, &primitive.light_ids})
    if (!ids->empty() && ids->size() != vertices) fail("ids do not match the vertices");
  if (!primitive.texture_coordinates.empty() && primitive.texture_coordinates.size() != vertices)
    fail("texture coordinates do not match the vertices");
  for (const glm::vec2& p : primitive.texture_coordinates)
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) fail("texture coordinate is not finite");
  for (const std::uint32_t id : primitive.feature_ids)
    if (id != no_id && id >= limits.features)
      fail("feature " + std::to_string(id) + " is not there");
  for (const std::uint32_t id : primitive.light_ids)
    if (id != no_id && id >= gltf::max_id) fail("light id is above 2^23 - 2");
}

json PrimitiveWriter::write_plain(const ScenePrimitive& primitive,
                                  std::span<const float> feature_ids,
                                  std::span<const float> light_ids) {
  const std::size_t count = primitive.positions.size();
  glm::vec3 min = primitive.positions[0], max = min;
  for (const glm::vec3& p : primitive.positions) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  const std::size_t positions =
      stream_.write_view(std::span(primitive.positions), gltf::array_buffer);
  json attributes = {
      {"POSITION", stream_.add_accessor(make_position_accessor(count, min, max), positions)}};
  const auto add_ids = [&](const char* name, std::span<const float> ids) {
    if (ids.empty()) return;
    const std::size_t view = stream_.write_view(ids, gltf::array_buffer);
    attributes[name] = stream_.add_accessor(make_accessor(gltf::float32, "SCALAR", count), view);
  };
  add_ids(gltf::feature_attribute, feature_ids);
  add_ids(gltf::light_attribute, light_ids);
  if (!primitive.texture_coordinates.empty())
    attributes[gltf::texture_attribute(0)] = stream_.add_accessor(
        make_accessor(gltf::float32, "VEC2", count),
        stream_.write_view(std::span(primitive.texture_coordinates), gltf::array_buffer));
  return {{"attributes", attributes}, {"indices", write_indices(primitive.indices, count)}};
}

// Returns the accessor of the indices, which take 16 bits each if that is enough.
std::size_t PrimitiveWriter::write_indices(const std::vector<std::uint32_t>& indices,
                                           std::size_t vertex_count) {
  if (vertex_count > max_vertices_of_16_bits) {
    const auto view = stream_.write_view(std::span(indices), gltf::element_array_buffer);
    return stream_.add_accessor(make_accessor(gltf::uint32, "SCALAR", indices.size()), view);
  }
  const std::vector<std::uint16_t> narrow(indices.begin(), indices.end());
  const auto view = stream_.write_view(std::span(narrow), gltf::element_array_buffer);
  return stream_.add_accessor(make_accessor(gltf::uint16, "SCALAR", indices.size()), view);
}

json PrimitiveWriter::write_draco(const DracoEncoded& encoded) {
  stream_.extensions_used.insert(gltf::draco);
  stream_.extensions_required.insert(gltf::draco);
  statistics_.max_draco_bits = std::max(statistics_.max_draco_bits, encoded.bits);
  statistics_.max_draco_error_m = std::max(statistics_.max_draco_error_m, encoded.error_m);
  const std::size_t count = encoded.vertex_count;
  json attributes = {
      {"POSITION",
       stream_.add_accessor(make_position_accessor(count, encoded.min, encoded.max), {})}};
  json draco_ids = {{"POSITION", encoded.position_id}};
  const auto add_ids = [&](const char* name, int id) {
    if (id < 0) return;
    attributes[name] = stream_.add_accessor(make_accessor(gltf::float32, "SCALAR", count), {});
    draco_ids[name] = id;
  };
  add_ids(gltf::feature_attribute, encoded.feature_id);
  add_ids(gltf::light_attribute, encoded.light_id);
  const int index_type = count > max_vertices_of_16_bits ? gltf::uint32 : gltf::uint16;
  const std::size_t view = stream_.write_view(std::span<const char>(encoded.bytes));
  const std::size_t indices =
      stream_.add_accessor(make_accessor(index_type, "SCALAR", encoded.index_count), {});
  return {{"attributes", attributes},
          {"indices", indices},
          {"extensions", {{gltf::draco, {{"bufferView", view}, {"attributes", draco_ids}}}}}};
}

}  // namespace nightcity
