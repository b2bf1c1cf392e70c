// Triangles sorted into tiles without keeping them in memory: a city larger than the memory is baked in the
// order in which it is read, and written tile by tile.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "formats/scene_file.h"
#include "tools/bake/scene/materials.h"
#include "tools/cell_file.h"

namespace nightcity {

struct TileKey {
  std::int32_t column,
      row;  // the tile spans [column, column + 1) * size in easting, likewise northing
  NodeKind kind;
  auto operator<=>(const TileKey&) const = default;
};

class TileStore {
 public:
  /// Scratch file beside `path`. `size_m`: of a tile. `base_height`: subtracted, so that floats keep
  /// millimetres.
  TileStore(const std::filesystem::path& path, double size_m, double base_height);

  /// One corner of the triangle: E, N, H in metres.
  struct Triangle {
    glm::dvec3 corners[3];
    MaterialCode material;
    NodeKind kind;
  };
  /// Adds an object's triangles, feature `feature`. An object goes whole into the tile of its centre unless
  /// it is larger than a tile (terrain, long roads): then each triangle goes by its own. `solid`: they bound
  /// a closed building.
  void add(std::span<const Triangle> triangles, std::uint32_t feature, bool solid = false);

  std::vector<TileKey> tiles();
  /// South-west corner at the base height: E, N, H. Positions of mesh() are relative to it, in model axes
  /// (x east, y up, z south).
  glm::dvec3 origin(const TileKey& tile) const;
  /// A triangle of a tile: corners relative to its origin(), in model axes.
  struct StoredTriangle {
    glm::vec3 corners[3];
    MaterialCode material;
    std::uint32_t feature;
    std::uint32_t solid;
  };
  /// Which of a tile's triangles are to be left out.
  using LeaveOut = std::function<std::vector<bool>(std::span<const StoredTriangle>)>;

  /// All triangles of a tile in the order in which they came, one primitive a material, equal vertices
  /// welded. A primitive's `material` is a MaterialCode: whoever writes it asks a MaterialTable.
  /// May be asked from many threads once tiles() has been, and until something is added.
  SceneMesh mesh(const TileKey& tile, const LeaveOut& leave_out = {});

 private:
  TileKey key_of(const glm::dvec3& point, NodeKind kind) const;

  double size_m_, base_height_;
  CellFile<TileKey, StoredTriangle> tiles_;
};

}  // namespace nightcity
