// Reads accessors of an opened glTF into plain arrays, every offset checked: the file may be hostile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "formats/gltf_document.h"

namespace nightcity::gltf {

/// All functions throw Error without a file name; read_scene adds it.
class AccessorReader {
 public:
  explicit AccessorReader(const Document& document) : document_(document) {}

  /// The bytes of a bufferView.
  std::span<const std::byte> view(std::size_t index) const;

  /// Values of an accessor with `components` a value, integers converted (normalised where the accessor says
  /// so).
  std::vector<float> floats(std::size_t accessor, int components) const;

  /// Indices of 8, 16 or 32 bits.
  std::vector<std::uint32_t> indices(std::size_t accessor) const;

 private:
  struct Layout {
    std::span<const std::byte> bytes;  // from the first value on
    std::size_t stride, count;
    std::size_t component_type;
    bool normalized;
  };
  Layout layout(std::size_t accessor, int components) const;

  const Document& document_;
};

}  // namespace nightcity::gltf
