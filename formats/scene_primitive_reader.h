// Reads the triangles of glTF primitives.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "formats/gltf_accessor.h"
#include "formats/gltf_document.h"
#include "formats/mapped_primitive.h"
#include "formats/scene.h"

namespace nightcity {

/// The range of Scene::features that one property table of a file fills.
struct FeatureRange {
  std::size_t first, count;
};

/// Returns the light ids stored as floats (attribute _LIGHT); negative values become no_id. Throws
/// Error if a value is too large for an id.
std::vector<std::uint32_t> to_light_ids(const std::vector<float>& values);

/// Returns the features that ids stored as floats stand for (attribute _FEATURE_ID_0), by what
/// `extension` of `source` (EXT_mesh_features, EXT_instance_features) says of them; nothing where
/// no property table says what they mean. Throws Error if an id lies outside its table.
std::vector<std::uint32_t> to_feature_ids(const gltf::Json& source, const char* extension,
                                          const std::vector<float>& values,
                                          const std::vector<FeatureRange>& tables);

class PrimitiveReader {
 public:
  explicit PrimitiveReader(const gltf::AccessorReader& accessors) : accessors_(accessors) {}

  /// Returns the triangles of a primitive, strips and fans as lists, without their material; empty
  /// for points, lines and primitives without POSITION, which have no surface. `colours` gets the
  /// vertices' colours (COLOR_0; linear, in [0, 1]), or is emptied. `tables` are the file's
  /// property tables. Throws Error without a file name if an index, an id or a position is wrong.
  std::optional<ScenePrimitive> read(const gltf::Json& source,
                                     const std::vector<FeatureRange>& tables,
                                     std::vector<glm::vec3>& colours) const;

  /// Returns the texture coordinates of a set (TEXCOORD_n), one for each of so many vertices; none
  /// where the primitive has none or one of them is not finite. Throws Error as read() does.
  std::vector<glm::vec2> read_texture_coordinates(const gltf::Json& source, std::uint32_t set,
                                                  std::size_t vertices) const;

  /// Returns the same triangles where they lie in the file, without their material; nothing where
  /// they are no plain list: strips, compressed or sparse values, colours of vertices. The values
  /// are checked by read(), or by is_fit().
  std::optional<MappedPrimitive> find(const gltf::Json& source,
                                      const std::vector<FeatureRange>& tables) const;

  /// Returns how many triangles a primitive of so many corners has; 0 for points and lines.
  static std::size_t count_triangles(const gltf::Json& source, std::size_t corners);

 private:
  struct VertexIds {
    std::vector<float> features, lights, colours;
    std::size_t colour_components = 3;
  };
  VertexIds read_geometry(const gltf::Json& source, ScenePrimitive& target) const;
  VertexIds read_plain(const gltf::Json& source, std::vector<float>& positions,
                       std::vector<std::uint32_t>& indices) const;
  VertexIds read_draco(const gltf::Json& draco, const gltf::Json& attributes,
                       std::vector<float>& positions, std::vector<std::uint32_t>& indices) const;
  /// Returns how many numbers a vertex's colour has, 0 without COLOR_0. Throws Error if it is
  /// neither 3 nor 4.
  std::size_t count_colour_components(const gltf::Json& attributes) const;

  const gltf::AccessorReader& accessors_;
};

}  // namespace nightcity
