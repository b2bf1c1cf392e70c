#include "formats/mapped_primitive.h"

#include "formats/finite.h"
#include "formats/gltf_constants.h"

namespace nightcity {
namespace {

bool has_fit_vertices(const MappedPrimitive& primitive) {
  std::uint32_t largest = 0;
  for (std::size_t corner = 0; corner < 3 * std::size_t{primitive.triangles}; ++corner)
    largest = std::max(largest, primitive.index(corner));
  bool fit = largest < primitive.vertices;
  for (std::uint32_t i = 0; i < primitive.vertices; ++i) fit &= finite(primitive.position(i));
  return fit;
}

}  // namespace

bool is_fit(const MappedPrimitive& primitive, VertexCheck vertices) {
  const auto load = [](const MappedPrimitive::Array& array, std::size_t vertex) {
    float value;
    std::memcpy(&value, array.first + vertex * array.stride, sizeof value);
    return value;
  };
  bool fit = vertices == VertexCheck::later || has_fit_vertices(primitive);
  if (primitive.features.first)
    for (std::size_t i = 0; i < primitive.vertices; ++i) {
      const float id = load(primitive.features, i);
      fit &= id == primitive.null_feature ||
             (id >= 0 && id < static_cast<float>(primitive.feature_count));
    }
  if (primitive.lights.first)
    for (std::size_t i = 0; i < primitive.vertices; ++i)
      fit &= load(primitive.lights, i) < static_cast<float>(gltf::max_id);
  return fit;
}

}  // namespace nightcity
