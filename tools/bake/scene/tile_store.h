// Triangles sorted into tiles on disk: a city larger than the memory is baked in the order in which
// it is read, and written tile by tile.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "formats/scene.h"
#include "formats/scratch_file.h"
#include "tools/bake/city/surface_pictures.h"
#include "tools/bake/scene/materials.h"
#include "tools/cell_file.h"
#include "tools/city/city_model.h"
#include "tools/mesh/triangle_mesh.h"

namespace nightcity::bake {

struct TileKey {
  std::int32_t column, row;  // as of Tile (tile_grid.h)
  NodeKind kind;
  auto operator<=>(const TileKey&) const = default;
};

class TileStore {
 public:
  /// Makes a scratch file beside `path`. `size_m` is the side of a tile. `base_height` is
  /// subtracted from heights, so that floats keep millimetres.
  TileStore(const std::filesystem::path& path, double size_m, double base_height);

  /// One corner of the triangle: E, N, H in metres.
  struct Triangle {
    glm::dvec3 corners[3];
    MaterialCode material;
    NodeKind kind;
    PicturedTriangle picture{};  // in a piece of those that are added with the triangle
  };
  /// Adds the triangles of one object, which is that feature of the scene. ObjectTiles decides
  /// which tile each goes to. `solid`: they bound a closed building.
  void add(std::span<const Triangle> triangles, std::uint32_t feature, bool solid = false,
           std::span<const PicturePiece> pieces = {});

  std::vector<TileKey> tiles();
  /// Returns the tile's south-west corner at the base height: E, N, H. Positions of mesh() are
  /// relative to it, in model axes (x east, y up, z south).
  glm::dvec3 origin(const TileKey& tile) const;
  /// A triangle of a tile: corners relative to its origin(), in model axes.
  struct StoredTriangle {
    glm::vec3 corners[3];
    MaterialCode material;
    std::uint32_t feature;
    std::uint32_t solid : 1;
    std::uint32_t picture : 31 = 0;  // 1 + number of its PicturedTriangle in the tile; 0 = none
  };
  /// Changes a tile's triangles before they are written: leaves some out, or cuts them.
  using Change = std::function<void(std::vector<StoredTriangle>&)>;

  /// A tile's mesh. A primitive's `material` is a MaterialCode, which a MaterialTable turns into an
  /// index; a primitive with texture coordinates lies in the picture of the same place in
  /// `picture_of_primitive`.
  struct TileMesh {
    SceneMesh mesh;
    std::vector<ScenePicture> pictures;
    std::vector<std::uint32_t> picture_of_primitive;  // parallel to the mesh's primitives
    std::uint64_t pieces = 0, texels = 0;             // of the pictures
    std::size_t flat = 0;                             // triangles that are not written: no area
  };
  /// Returns the triangles of a tile in the order in which they came, one primitive a material and
  /// picture, equal vertices welded. Triangles that rounding to floats leaves without an area, in
  /// the tile or where `to_model` places it, are counted alone. May be called from many threads
  /// after tiles(), until something is added.
  TileMesh mesh(const TileKey& tile, const glm::dmat4& to_model, const Change& change = {});

 private:
  struct StoredPiece {
    std::uint64_t offset;  // in pieces_
    std::uint32_t width, height;
  };
  using PieceNumbers = std::map<std::pair<TileKey, std::uint32_t>, std::uint32_t>;
  std::uint32_t add_picture(const TileKey& key, const PicturedTriangle& picture,
                            std::span<const PicturePiece> pieces, PieceNumbers& numbers);
  std::vector<PicturePiece> read_pieces(const TileKey& key);

  double size_m_, base_height_;
  CellFile<TileKey, StoredTriangle> tiles_;
  // Pictures: where they lie on the triangles of a tile, and what they show.
  CellFile<TileKey, PicturedTriangle> pictured_;
  CellFile<TileKey, StoredPiece> stored_pieces_;
  ScratchFile pieces_;
  struct Counts {
    std::uint32_t triangles = 0, pieces = 0;
  };
  std::map<TileKey, Counts> counts_;  // of tiles with pictures
};

/// Returns the triangles of an object's mesh with their materials and their places in its pictures.
/// `leave_out_ground`: without its ground surfaces.
std::vector<TileStore::Triangle> make_tile_triangles(const mesh::TriangleMesh& mesh,
                                                     const city::CityObject& object,
                                                     const SurfacePictures& pictures = {},
                                                     bool leave_out_ground = false);

/// Adds a mesh that belongs to no object of the model (made ground), with the material of that
/// type.
void add_mesh(TileStore& tiles, const mesh::TriangleMesh& mesh, city::ObjectType type,
              std::uint32_t feature);

}  // namespace nightcity::bake
