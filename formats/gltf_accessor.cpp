#include "formats/gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>

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

bool is_index_type(std::size_t type) {
  return type == uint8 || type == uint16 || type == uint32;
}

std::uint32_t as_index(const std::byte* bytes, std::size_t type) {
  switch (type) {
    case uint8:
      return load<std::uint8_t>(bytes);
    case uint16:
      return load<std::uint16_t>(bytes);
    default:
      return load<std::uint32_t>(bytes);
  }
}

// An accessor without data takes no room in the file, so its size needs a bound of its own: a short
// file must not choose how much memory is allocated.
constexpr std::size_t max_zeros = 1u << 24;

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
  Layout layout{};
  layout.component_type = gltf::index(accessor, "componentType").value_or(0);
  layout.component_size = component_size(layout.component_type);
  layout.components = static_cast<std::size_t>(components);
  layout.count = gltf::index(accessor, "count").value_or(0);
  layout.normalized = boolean(accessor, "normalized", false);
  const std::string shape = components == 1 ? "SCALAR" : "VEC" + std::to_string(components);
  if (layout.component_size == 0 || text(accessor, "type") != shape)
    throw Error("", place, "has another type than its use asks for");
  const std::size_t element = layout.component_size * layout.components;
  if (gltf::index(accessor, "bufferView")) {
    layout.values = elements(accessor, layout.count, element, place);
  } else if (layout.count > max_zeros) {
    throw Error("", place,
                "has " + std::to_string(layout.count) + " values without data, of at most " +
                    std::to_string(max_zeros));
  }
  const Json& sparse = member(accessor, "sparse");
  if (!sparse.is_object()) return layout;
  layout.replaced = gltf::index(sparse, "count").value_or(0);
  if (layout.replaced > layout.count) throw Error("", place, "has more sparse values than values");
  const Json& places = member(sparse, "indices");
  layout.place_type = gltf::index(places, "componentType").value_or(0);
  if (!is_index_type(layout.place_type))
    throw Error("", place, "has sparse indices that are no unsigned integers");
  layout.places = elements(places, layout.replaced, component_size(layout.place_type), place);
  layout.replacements = elements(member(sparse, "values"), layout.replaced, element, place);
  return layout;
}

AccessorReader::Elements AccessorReader::elements(const Json& source, std::size_t count,
                                                  std::size_t element,
                                                  const std::string& place) const {
  if (count == 0) return {};
  const auto view_index = gltf::index(source, "bufferView");
  if (!view_index) throw Error("", place, "has no data for its sparse values");
  const auto bytes = view(*view_index);
  const std::size_t offset = gltf::index(source, "byteOffset").value_or(0);
  const std::size_t stride =
      gltf::index(document_.element("bufferViews", *view_index), "byteStride").value_or(element);
  // A division, because count * stride could overflow.
  if (stride < element || offset > bytes.size() || bytes.size() - offset < element ||
      (bytes.size() - offset - element) / stride < count - 1)
    throw Error("", place, "lies outside its bufferView");
  return {bytes.data() + offset, stride};
}

template <class T, class Load>
std::vector<T> AccessorReader::values(std::size_t index, const Layout& layout, Load load) const {
  const std::size_t width = layout.components;
  std::vector<T> values(layout.count * width);
  const auto read = [&](const std::byte* bytes, std::size_t element) {
    for (std::size_t c = 0; c < width; ++c)
      values[element * width + c] = load(bytes + c * layout.component_size);
  };
  if (layout.values.first && layout.component_type == float32 && std::is_same_v<T, float> &&
      layout.values.stride == sizeof(float) * width)
    std::memcpy(values.data(), layout.values.first, values.size() * sizeof(float));
  else if (layout.values.first)
    for (std::size_t i = 0; i < layout.count; ++i)
      read(layout.values.first + i * layout.values.stride, i);
  for (std::size_t i = 0; i < layout.replaced; ++i) {
    const std::size_t element =
        as_index(layout.places.first + i * layout.places.stride, layout.place_type);
    if (element >= layout.count)
      throw Error("", "accessor " + std::to_string(index),
                  "has a sparse value for element " + std::to_string(element) + " of " +
                      std::to_string(layout.count));
    read(layout.replacements.first + i * layout.replacements.stride, element);
  }
  return values;
}

std::vector<float> AccessorReader::floats(std::size_t index, int components) const {
  const Layout layout = this->layout(index, components);
  return values<float>(index, layout, [&](const std::byte* bytes) {
    return as_float(bytes, layout.component_type, layout.normalized);
  });
}

std::vector<std::uint32_t> AccessorReader::indices(std::size_t index) const {
  const Layout layout = this->layout(index, 1);
  if (!is_index_type(layout.component_type))
    throw Error("", "accessor " + std::to_string(index),
                "holds indices that are no unsigned integers");
  return values<std::uint32_t>(index, layout, [&](const std::byte* bytes) {
    return as_index(bytes, layout.component_type);
  });
}

std::optional<AccessorReader::Place> AccessorReader::find(std::size_t index, int components) const {
  const Layout layout = this->layout(index, components);
  if (!layout.values.first || layout.replaced != 0 || layout.normalized) return {};
  return Place{layout.values.first, layout.values.stride, layout.count, layout.component_type};
}

int AccessorReader::components(std::size_t index) const {
  const std::string type = text(document_.element("accessors", index), "type");
  if (type == "SCALAR") return 1;
  return type.size() == 4 && type.starts_with("VEC") && type[3] >= '2' && type[3] <= '4'
             ? type[3] - '0'
             : 0;
}

}  // namespace nightcity::gltf
