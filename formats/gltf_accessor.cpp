#include "formats/gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

#include "formats/error.h"
#include "formats/gltf_constants.h"

namespace nightcity::gltf {
namespace {

std::size_t component_size(std::size_t type) {
  switch (type) {
    case int8:
    case uint8:
      return 1;
    case int16:
    case uint16:
      return 2;
    case uint32:
    case float32:
      return 4;
    default:
      return 0;
  }
}

template <class T>
T load(const std::byte* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

// Returns an integer as it is or, if normalised, scaled to [0, 1] or [-1, 1] (glTF 2.0, section
// 3.11).
template <class T>
float integer(const std::byte* bytes, bool normalized) {
  const float value = static_cast<float>(load<T>(bytes));
  return normalized ? std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0f)
                    : value;
}

float as_float(const std::byte* bytes, std::size_t type, bool normalized) {
  switch (type) {
    case int8:
      return integer<std::int8_t>(bytes, normalized);
    case uint8:
      return integer<std::uint8_t>(bytes, normalized);
    case int16:
      return integer<std::int16_t>(bytes, normalized);
    case uint16:
      return integer<std::uint16_t>(bytes, normalized);
    case uint32:
      return integer<std::uint32_t>(bytes, normalized);
    default:
      return load<float>(bytes);
  }
}

}  // namespace

std::span<const std::byte> AccessorReader::view(std::size_t index) const {
  const Json& view = document_.element("bufferViews", index);
  const auto buffer = gltf::index(view, "buffer"), length = gltf::index(view, "byteLength");
  const std::string place = "bufferView " + std::to_string(index);
  if (!buffer || !length) throw Error("", place, "names no buffer or length");
  const auto data = document_.buffer(*buffer);
  const std::size_t offset = gltf::index(view, "byteOffset").value_or(0);
  if (offset > data.size() || *length > data.size() - offset)
    throw Error("", place, "lies outside its buffer");
  return data.subspan(offset, *length);
}

AccessorReader::Layout AccessorReader::layout(std::size_t index, int components) const {
  const Json& accessor = document_.element("accessors", index);
  const std::string place = "accessor " + std::to_string(index);
  const std::size_t type = gltf::index(accessor, "componentType").value_or(0);
  const std::size_t size = component_size(type), count = gltf::index(accessor, "count").value_or(0);
  const std::string shape = components == 1 ? "SCALAR" : "VEC" + std::to_string(components);
  if (size == 0 || text(accessor, "type") != shape)
    throw Error("", place, "has another type than its use asks for");
  if (accessor.contains("sparse"))
    throw Error("", place, "is sparse, which this reader does not know");
  const auto view_index = gltf::index(accessor, "bufferView");
  if (!view_index) throw Error("", place, "has no data");
  const auto bytes = view(*view_index);
  const std::size_t offset = gltf::index(accessor, "byteOffset").value_or(0);
  const std::size_t element = size * static_cast<std::size_t>(components);
  const std::size_t stride =
      gltf::index(document_.element("bufferViews", *view_index), "byteStride").value_or(element);
  // A division, because count * stride could overflow.
  if (stride < element || count == 0 || offset > bytes.size() || bytes.size() - offset < element ||
      (bytes.size() - offset - element) / stride < count - 1)
    throw Error("", place, "lies outside its bufferView");
  return {bytes.subspan(offset), stride, count, type, boolean(accessor, "normalized", false)};
}

std::vector<float> AccessorReader::floats(std::size_t index, int components) const {
  const Layout layout = this->layout(index, components);
  const std::size_t size = component_size(layout.component_type),
                    width = static_cast<std::size_t>(components);
  std::vector<float> values(layout.count * width);
  if (layout.component_type == float32 && layout.stride == size * width) {
    std::memcpy(values.data(), layout.bytes.data(), values.size() * sizeof(float));
    return values;
  }
  for (std::size_t i = 0; i < layout.count; ++i)
    for (std::size_t c = 0; c < width; ++c)
      values[i * width + c] = as_float(layout.bytes.data() + i * layout.stride + c * size,
                                       layout.component_type, layout.normalized);
  return values;
}

std::vector<std::uint32_t> AccessorReader::indices(std::size_t index) const {
  const Layout layout = this->layout(index, 1);
  std::vector<std::uint32_t> values(layout.count);
  for (std::size_t i = 0; i < layout.count; ++i) {
    const std::byte* bytes = layout.bytes.data() + i * layout.stride;
    switch (layout.component_type) {
      case uint8:
        values[i] = load<std::uint8_t>(bytes);
        break;
      case uint16:
        values[i] = load<std::uint16_t>(bytes);
        break;
      case uint32:
        values[i] = load<std::uint32_t>(bytes);
        break;
      default:
        throw Error("", "accessor " + std::to_string(index),
                    "holds indices that are no unsigned integers");
    }
  }
  return values;
}

}  // namespace nightcity::gltf
