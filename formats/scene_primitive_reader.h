// Reads the triangles of glTF primitives.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "formats/gltf_accessor.h"
#include "formats/gltf_document.h"
#include "formats/scene.h"

namespace nightcity {

/// Where the features of each property table of a file lie in Scene::features.
struct FeatureRange {
  std::size_t first, count;
};

/// Returns the light ids stored as floats (attribute _LIGHT); negative values become no_id. Throws
/// Error if a value is too large for an id.
std::vector<std::uint32_t> to_light_ids(const std::vector<float>& values);

class PrimitiveReader {
 public:
  explicit PrimitiveReader(const gltf::AccessorReader& accessors) : accessors_(accessors) {}

  /// Returns the triangles of a primitive, strips and fans as lists, without their material; empty
  /// for points and lines, which have no surface. `tables` are the file's property tables. Throws
  /// Error without a file name if an index, an id or a position is wrong.
  std::optional<ScenePrimitive> read(const gltf::Json& source,
                                     const std::vector<FeatureRange>& tables) const;

 private:
  struct VertexIds {
    std::vector<float> features, lights;
  };
  VertexIds read_geometry(const gltf::Json& source, ScenePrimitive& target) const;
  VertexIds read_plain(const gltf::Json& source, std::vector<float>& positions,
                       std::vector<std::uint32_t>& indices) const;
  VertexIds read_draco(const gltf::Json& draco, std::vector<float>& positions,
                       std::vector<std::uint32_t>& indices) const;

  const gltf::AccessorReader& accessors_;
};

}  // namespace nightcity
