// The triangles of a scene file where they lie in memory: most files hold plain arrays, which a
// program can read in place, so that a large city is not in memory a second time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "formats/scene.h"

namespace nightcity {

/// A primitive as SceneFile::read_mesh returns it, whose values are read when they are asked for.
/// The file may have been rewritten since it was checked: numbers beyond their arrays become the
/// last ones there, ids beyond theirs become no_id.
struct MappedPrimitive {
  /// Values of vertices.
  struct Array {
    const std::byte* first = nullptr;  // null: there are none
    std::size_t stride = 0;
  };
  Array positions, features, lights;  // floats
  Array indices;                      // null: vertices follow each other as they are
  std::size_t index_bytes = 0;        // 1, 2 or 4
  std::uint32_t vertices = 0, triangles = 0;
  std::uint32_t material = 0;
  std::uint32_t first_feature = 0, feature_count = 0;  // of the property table
  float null_feature = -1;

  /// Returns the vertices of a triangle, `triangle` < triangles.
  std::array<std::uint32_t, 3> corners(std::size_t triangle) const {
    const auto at = [&](std::size_t k) {
      // Nearly all are of two bytes: a single branch instead of three, once this is inlined.
      const std::uint32_t found = index_bytes == 2 && indices.first
                                      ? load<std::uint16_t>(index_place(3 * triangle + k))
                                      : index(3 * triangle + k);
      return std::min(found, vertices - 1);
    };
    // In registers: to copy an array that was written number by number waits for its memory.
    const std::uint32_t a = at(0), b = at(1), c = at(2);
    return {a, b, c};
  }
  /// Returns whether the vertices of a triangle are there, as the file has them.
  bool has_vertices(std::size_t triangle) const {
    return std::max({index(3 * triangle), index(3 * triangle + 1), index(3 * triangle + 2)}) <
           vertices;
  }
  /// Returns the vertex of a corner as the file has it, `corner` < 3 * triangles.
  std::uint32_t index(std::size_t corner) const {
    if (!indices.first) return static_cast<std::uint32_t>(corner);
    const std::byte* bytes = index_place(corner);
    return index_bytes == 1   ? load<std::uint8_t>(bytes)
           : index_bytes == 2 ? load<std::uint16_t>(bytes)
                              : load<std::uint32_t>(bytes);
  }
  /// Returns the place of that index, null where there are no indices.
  const std::byte* index_place(std::size_t corner) const {
    return indices.first ? indices.first + corner * indices.stride : nullptr;
  }
  /// Returns the place of a vertex's three floats.
  const std::byte* position_place(std::uint32_t vertex) const {
    return positions.first + vertex * positions.stride;
  }
  glm::vec3 position(std::uint32_t vertex) const {
    glm::vec3 result;
    std::memcpy(&result, position_place(vertex), sizeof result);
    return result;
  }
  std::uint32_t feature(std::uint32_t vertex) const {
    if (!features.first) return no_id;
    const float value = load<float>(features.first + vertex * features.stride);
    return value != null_feature && value >= 0 && value < static_cast<float>(feature_count)
               ? first_feature + static_cast<std::uint32_t>(value)
               : no_id;
  }
  std::uint32_t light(std::uint32_t vertex) const {
    if (!lights.first) return no_id;
    const float value = load<float>(lights.first + vertex * lights.stride);
    return value >= 0 && value < 16777216.0f ? static_cast<std::uint32_t>(value) : no_id;
  }

 private:
  template <class T>
  static T load(const std::byte* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }
};

/// When the vertices of mapped triangles are looked at: whether they are there, and finite.
enum class VertexCheck {
  now,
  later  ///< by whoever reads them (has_vertices), which spares a walk over all of the file
};

/// Returns whether the values of a primitive are those that PrimitiveReader::read() accepts: ids
/// are in their ranges and, where they are looked at now, indices too and positions finite.
bool is_fit(const MappedPrimitive& primitive, VertexCheck vertices);

/// One for each primitive of a mesh; nothing for those that cannot be read in place.
using MappedMesh = std::vector<std::optional<MappedPrimitive>>;

}  // namespace nightcity
