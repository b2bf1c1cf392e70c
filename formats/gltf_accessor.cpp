#include "formats/gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

#include "formats/error.h"
#include "formats/gltf_constants.h"

namespace nightcity::gltf {
namespace {

std::size_t component_size(int type) {
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

// Integers stand for themselves, or for [0, 1] and [-1, 1] where normalised (glTF 2.0, section 3.11).
template <class T>
float integer(const std::byte* bytes, bool normalized) {
  const float value = static_cast<float>(load<T>(bytes));
  return normalized ? std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0f) : value;
}

float as_float(const std::byte* bytes, int type, bool normalized) {
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

const tinygltf::Accessor& AccessorReader::accessor(std::int64_t index) const {
  if (index < 0 || index >= static_cast<std::int64_t>(model_.accessors.size()))
    throw Error("", "accessor " + std::to_string(index), "is not there");
  return model_.accessors[static_cast<std::size_t>(index)];
}

std::span<const std::byte> AccessorReader::view(std::int64_t index) const {
  const std::string place = "bufferView " + std::to_string(index);
  if (index < 0 || index >= static_cast<std::int64_t>(model_.bufferViews.size()))
    throw Error("", place, "is not there");
  const tinygltf::BufferView& view = model_.bufferViews[static_cast<std::size_t>(index)];
  if (view.buffer < 0 || view.buffer >= static_cast<int>(model_.buffers.size()))
    throw Error("", place, "names a buffer that is not there");
  const auto& data = model_.buffers[static_cast<std::size_t>(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
    throw Error("", place, "lies outside its buffer");
  return std::as_bytes(std::span(data)).subspan(view.byteOffset, view.byteLength);
}

AccessorReader::Layout AccessorReader::layout(std::int64_t index, int components) const {
  const tinygltf::Accessor& a = accessor(index);
  const std::string place = "accessor " + std::to_string(index);
  const std::size_t size = component_size(a.componentType);
  if (size == 0 || tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(a.type)) != components)
    throw Error("", place, "has another type than its use asks for");
  if (a.sparse.isSparse) throw Error("", place, "is sparse, which this reader does not know");
  if (a.bufferView < 0) throw Error("", place, "has no data");
  const auto bytes = view(a.bufferView);
  const std::size_t element = size * static_cast<std::size_t>(components);
  const std::size_t given = model_.bufferViews[static_cast<std::size_t>(a.bufferView)].byteStride;
  const std::size_t stride = given == 0 ? element : given;
  // count * stride could overflow: divide instead.
  if (stride < element || a.byteOffset > bytes.size() || a.count == 0 ||
      bytes.size() - a.byteOffset < element || (bytes.size() - a.byteOffset - element) / stride < a.count - 1)
    throw Error("", place, "lies outside its bufferView");
  return {bytes.subspan(a.byteOffset), stride, a.count, a.componentType, a.normalized};
}

std::vector<float> AccessorReader::floats(std::int64_t index, int components) const {
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

std::vector<std::uint32_t> AccessorReader::indices(std::int64_t index) const {
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
        throw Error("", "accessor " + std::to_string(index), "holds indices that are no unsigned integers");
    }
  }
  return values;
}

}  // namespace nightcity::gltf
