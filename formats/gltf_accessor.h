// Reads the accessors of a glTF document into arrays. Every offset is checked: the file may be
// hostile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
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
  /// normalised if the accessor says so. Values without data are zeros, and sparse values replace
  /// those at their places (glTF 2.0, section 3.6.2).
  std::vector<float> floats(std::size_t accessor, int components) const;

  /// Returns the indices of an accessor, which are of 8, 16 or 32 bits in the file.
  std::vector<std::uint32_t> indices(std::size_t accessor) const;

  /// The place of an accessor's values, which lie one after the other with a stride.
  struct Place {
    const std::byte* first;
    std::size_t stride, count;
    std::size_t component_type;
  };
  /// Returns the place of an accessor's values where these are plain: neither normalised nor sparse
  /// nor without data. Throws Error as floats() does.
  std::optional<Place> find(std::size_t accessor, int components) const;

  /// Returns how many numbers an element has: 1 to 4, or 0 for a matrix or an unknown type.
  int components(std::size_t accessor) const;

 private:
  struct Elements {
    const std::byte* first = nullptr;  // null: there are none
    std::size_t stride = 0;
  };
  struct Layout {
    std::size_t count, components, component_type, component_size;
    bool normalized;
    Elements values;  // none: all are zero
    // Sparse values: the elements that they replace, and the values themselves.
    std::size_t replaced, place_type;
    Elements places, replacements;
  };
  Layout layout(std::size_t accessor, int components) const;
  /// Finds `count` elements of `element` bytes in the bufferView that `source` names.
  Elements elements(const Json& source, std::size_t count, std::size_t element,
                    const std::string& place) const;
  template <class T, class Load>
  std::vector<T> values(std::size_t accessor, const Layout& layout, Load load) const;

  const Document& document_;
};

}  // namespace nightcity::gltf
