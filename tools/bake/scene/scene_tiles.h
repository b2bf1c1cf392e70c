// The city's own surfaces in city.glb: gathered while it is read and written tile by tile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "formats/scene_writer.h"
#include "tools/bake/city/city.h"
#include "tools/bake/city/city_consumer.h"
#include "tools/bake/city/picture_budget.h"
#include "tools/bake/progress.h"
#include "tools/bake/report/scene_report.h"
#include "tools/bake/scene/cover_ground.h"
#include "tools/bake/scene/drape.h"
#include "tools/bake/scene/materials.h"
#include "tools/bake/scene/skin_buildings.h"
#include "tools/bake/scene/tile_store.h"
#include "tools/barriers/barrier_shape.h"
#include "tools/steps/flight_shape.h"
#include "tools/trees/model_tree.h"

namespace nightcity::bake {

struct SceneTileOptions {
  double tile_m = 250;       // side of a tile
  bool drop_ground = false;  // leave out the ground surfaces under buildings: nothing sees them
  bool drop_hidden = false;  // leave out walls between houses and what lies below the ground
  bool skins = true;         // give buildings without a colour the finish of their use and age
  trees::Vegetation vegetation = trees::Vegetation::trees;  // of the model
  unsigned threads = 0;                                     // 0: one a core
  std::shared_ptr<PictureBudget> picture_budget{};          // null: no limit
};

/// Each object becomes a feature of the writer, and its triangles wait on disk, sorted into tiles.
class SceneTiles final : public CityConsumer {
 public:
  /// Adds the table of materials to `writer`, which must outlive the tiles. Scratch files lie
  /// beside `scratch`. `base_height` is subtracted from heights, so that floats keep millimetres.
  /// `use_at`: what the map says of the use of buildings (make_use_finder).
  SceneTiles(SceneWriter& writer, const std::filesystem::path& scratch,
             const SceneTileOptions& options, double base_height, lights::UseAt use_at);

  Turn prepare(const std::shared_ptr<const PreparedObject>& prepared) override;
  /// Adds ground that belongs to no object. E, N, H in metres.
  void add_ground(const mesh::TriangleMesh& mesh);

  /// Adds a surface of a barrier: E, N, H in metres.
  void add_barrier(std::span<const barriers::Corners> surface, barriers::BarrierMaterial material);

  /// Adds a flight of steps: E, N, H in metres.
  void add_steps(std::span<const steps::Corners> surface, ground_cover::GroundKind material);

  /// Adds surfaces of a bridge.
  void add_bridge(std::span<const TileStore::Triangle> triangles) { tiles_.add(triangles, no_id); }

  /// Puts the objects that were published without heights onto the ground.
  void drape(const place::HeightAt& height_at) { report_.draped = drape_.drape(height_at, tiles_); }
  /// Returns the writer's index of the material of bare ground.
  std::uint32_t ground_material() { return materials_.find_index(to_code(BakeMaterial::terrain)); }
  bool empty() { return tiles_.tiles().empty(); }
  /// Returns easting and northing of the city's middle, to the metre: the median of the tiles, so
  /// that far objects do not move it. There must be tiles.
  glm::dvec2 middle();
  /// Returns the rectangle that the tiles fill. There must be tiles.
  terrain::Extent extent();

  /// Writes one mesh for each tile and kind. The city's cover is laid onto its ground; its terrain
  /// decides what lies below the ground, for the option drop_hidden. Throws Error.
  SceneTilesReport write(const Georeference& georeference, const City& city,
                         const ProgressSink& progress);

 private:
  struct WrittenTile;
  SceneInstance place(const TileKey& key, const Georeference& georeference) const;
  WrittenTile build(const TileKey& key, const SceneInstance& place, const City& city);
  void write(WrittenTile&& tile);
  void count(const CoverCounts& cover);
  std::span<const PicturePiece> find_pieces(const PreparedObject& prepared);
  bool stands_otherwise(const PreparedObject& prepared) const;
  std::uint32_t add_feature(const city::CityObject& object);

  SceneWriter& writer_;
  SceneTileOptions options_;
  MaterialTable materials_;
  BuildingSkinner skinner_;
  TileStore tiles_;
  DrapeStore drape_;
  std::uint32_t last_feature_ = no_id;
  SceneTilesReport report_;
};

}  // namespace nightcity::bake
