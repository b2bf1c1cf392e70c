// Reads the accessors of a glTF document into arrays. Every offset is checked: the file may be
// hostile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "formats/gltf_document.h"

namespace nightcity::gltf {

/// All functions throw Error without a file name, which read_scene adds.
class AccessorReader {
 public:
  explicit AccessorReader(const Document& document) : document_(document) {}

  /// Returns the bytes of a bufferView.
  std::span<const std::byte> view(std::size_t index) const;

  /// Returns the values of an accessor, `components` numbers each. Integers are converted, and
  /// normalised if the accessor says so.
  std::vector<float> floats(std::size_t accessor, int components) const;

  /// Returns the indices of an accessor, which are of 8, 16 or 32 bits in the file.
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
