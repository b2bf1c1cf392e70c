// Reads accessors of a parsed glTF into plain arrays, every offset checked: the file may be hostile.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <optional>
#include <span>
#include <vector>

namespace nightcity::gltf {

/// All functions throw Error without a file name; read_scene adds it.
class AccessorReader {
 public:
  explicit AccessorReader(const tinygltf::Model& model) : model_(model) {}

  /// The bytes of a bufferView.
  std::span<const std::byte> view(std::int64_t index) const;

  /// Values of an accessor with `components` a value, integers converted (normalised where the accessor says
  /// so).
  std::vector<float> floats(std::int64_t accessor, int components) const;

  /// Indices of 8, 16 or 32 bits.
  std::vector<std::uint32_t> indices(std::int64_t accessor) const;

  const tinygltf::Accessor& accessor(std::int64_t index) const;

 private:
  struct Layout {
    std::span<const std::byte> bytes;  // from the first value on
    std::size_t stride, count;
    int component_type;
    bool normalized;
  };
  Layout layout(std::int64_t accessor, int components) const;

  const tinygltf::Model& model_;
};

}  // namespace nightcity::gltf
