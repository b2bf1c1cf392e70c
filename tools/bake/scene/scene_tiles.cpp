#include "tools/bake/scene/scene_tiles.h"

#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "formats/median.h"
#include "tools/bake/scene/hidden_surfaces.h"
#include "tools/in_order.h"

namespace nightcity::bake {
namespace {

// A surface this far below the ground is hidden. The ground's height is not known more exactly.
constexpr double hidden_below_m = 0.1;

void add_count(std::map<std::string, std::size_t>& counts, const char* name, std::size_t number) {
  if (number > 0) counts[name] += number;
}

}  // namespace

struct SceneTiles::WrittenTile {
  TileKey key;
  SceneInstance place;
  TileStore::TileMesh made;
  HiddenCounts hidden;
  CoverCounts cover;
};

SceneTiles::SceneTiles(SceneWriter& writer, const std::filesystem::path& scratch,
                       const SceneTileOptions& options, double base_height, lights::UseAt use_at)
    : writer_(writer),
      options_(options),
      materials_(writer),
      skinner_(std::move(use_at)),
      tiles_(scratch, options.tile_m, base_height),
      drape_(scratch) {}

CityConsumer::Turn SceneTiles::prepare(const std::shared_ptr<const PreparedObject>& prepared) {
  if (prepared->mesh.triangles.empty()) return {};  // points or lines alone
  if (stands_otherwise(*prepared))
    return [this, number = prepared->mesh.triangles.size()](bool) {
      add_count(report_.left_out, "triangles of vegetation", number);
    };
  const bool is_building = prepared->object.type == city::ObjectType::building;
  const bool drop = options_.drop_ground && is_building;
  std::optional<BuildingSkin> skin;
  if (options_.skins && is_building) skin = skinner_.find_skin(*prepared);
  return [this, prepared, skin,
          triangles = make_tile_triangles(prepared->mesh, prepared->object, prepared->pictures,
                                          drop)](bool continues) mutable {
    add_count(report_.left_out, "triangles of ground under buildings",
              prepared->mesh.triangles.size() - triangles.size());
    if (!continues) last_feature_ = add_feature(prepared->object);
    if (skin) skinner_.apply(*skin, prepared->object, continues, triangles);
    if (prepared->lacks_heights)
      drape_.add(triangles, last_feature_);
    else
      tiles_.add(triangles, last_feature_, prepared->closed, find_pieces(*prepared));
  };
}

// Returns the pictures of an object: none where the budget has ended, and then its surfaces keep
// their mean colours.
std::span<const PicturePiece> SceneTiles::find_pieces(const PreparedObject& prepared) {
  const std::vector<PicturePiece>& pieces = prepared.pictures.pieces;
  if (options_.picture_budget && prepared.pictured_polygons > 0 &&
      !options_.picture_budget->take(pieces, prepared.pictured_polygons))
    return {};
  return pieces;
}

// Returns whether the object's surfaces are not shown: it becomes a tree, or nothing.
bool SceneTiles::stands_otherwise(const PreparedObject& prepared) const {
  switch (options_.vegetation) {
    case trees::Vegetation::trees:
      return prepared.tree.has_value();
    case trees::Vegetation::none:
      return prepared.object.type == city::ObjectType::vegetation;
    case trees::Vegetation::surfaces:
      break;
  }
  return false;
}

void SceneTiles::add_ground(const mesh::TriangleMesh& mesh) {
  add_mesh(tiles_, mesh, city::ObjectType::relief, no_id);
}

void SceneTiles::add_barrier(std::span<const barriers::Corners> surface,
                             barriers::BarrierMaterial material) {
  std::vector<TileStore::Triangle> triangles;
  for (const barriers::Corners& corners : surface)
    triangles.push_back(
        {{corners[0], corners[1], corners[2]}, to_code(material), NodeKind::barrier});
  tiles_.add(triangles, no_id);
}

void SceneTiles::add_steps(std::span<const steps::Corners> surface,
                           ground_cover::GroundKind material) {
  std::vector<TileStore::Triangle> triangles;
  for (const steps::Corners& corners : surface)
    triangles.push_back({{corners[0], corners[1], corners[2]}, to_code(material), NodeKind::road});
  tiles_.add(triangles, no_id);
}

glm::dvec2 SceneTiles::middle() {
  std::vector<double> eastings, northings;
  for (const TileKey& key : tiles_.tiles()) {
    eastings.push_back(tiles_.origin(key).x);
    northings.push_back(tiles_.origin(key).y);
  }
  return {std::round(median(std::move(eastings))), std::round(median(std::move(northings)))};
}

terrain::Extent SceneTiles::extent() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  terrain::Extent extent{glm::dvec2(infinity), glm::dvec2(-infinity)};
  for (const TileKey& key : tiles_.tiles()) {
    const glm::dvec2 corner(tiles_.origin(key));
    extent.low = glm::min(extent.low, corner);
    extent.high = glm::max(extent.high, corner + options_.tile_m);
  }
  return extent;
}

SceneTilesReport SceneTiles::write(const Georeference& georeference, const City& city,
                                   const ProgressSink& progress) {
  const std::vector<TileKey> keys = tiles_.tiles();
  if (options_.picture_budget)
    report_.textures.beyond_limit = options_.picture_budget->surfaces_left_out();
  HiddenCounts hidden;
  std::size_t begun = 0, done = 0, flat = 0;
  const auto next = [&] {
    return begun < keys.size() ? std::optional(keys[begun++]) : std::nullopt;
  };
  in_order(
      options_.threads, next,
      [&](const TileKey& key) { return build(key, place(key, georeference), city); },
      [&](WrittenTile&& tile) {
        hidden.between += tile.hidden.between;
        hidden.below += tile.hidden.below;
        flat += tile.made.flat;
        count(tile.cover);
        if (tile.made.mesh.primitives.empty()) return;
        write(std::move(tile));
        if (progress) progress({"writing tiles", ++done, "tiles", keys.size()});
      });
  add_count(report_.left_out, "triangles between two buildings", hidden.between);
  add_count(report_.left_out, "triangles of buildings below the ground", hidden.below);
  add_count(report_.left_out, "triangles without area once rounded to floats", flat);
  report_.colours = materials_.colours();
  report_.skins = skinner_.report();
  return report_;
}

SceneInstance SceneTiles::place(const TileKey& key, const Georeference& georeference) const {
  SceneInstance instance;
  instance.to_model[3] = glm::vec4(glm::vec3(georeference.to_model(tiles_.origin(key))), 1);
  return instance;
}

SceneTiles::WrittenTile SceneTiles::build(const TileKey& key, const SceneInstance& place,
                                          const City& city) {
  WrittenTile tile{key, place, {}, {}, {}};
  const glm::dvec3 corner = tiles_.origin(key);
  const auto is_below = [&](const glm::vec3& p) {
    const auto ground = city.terrain().height_of(terrain::SurfaceClass::terrain,
                                                 {corner.x + double{p.x}, corner.y - double{p.z}});
    return ground && corner.z + double{p.y} < *ground - hidden_below_m;
  };
  const auto change = [&](std::vector<TileStore::StoredTriangle>& triangles) {
    if (options_.drop_hidden) {
      const std::vector<bool> hidden = find_hidden_triangles(triangles, is_below, tile.hidden);
      std::size_t i = 0;
      std::erase_if(triangles, [&](const auto&) { return hidden[i++]; });
    }
    if (key.kind == NodeKind::terrain && !city.cover().empty())
      cover_ground(city.cover(), corner, triangles, tile.cover);
  };
  tile.made = tiles_.mesh(key, to_double(place), change);
  return tile;
}

void SceneTiles::write(WrittenTile&& tile) {
  SceneMesh& mesh = tile.made.mesh;
  std::vector<std::uint32_t> pictures;
  for (const ScenePicture& picture : tile.made.pictures) {
    pictures.push_back(writer_.add_picture(picture));
    report_.textures.bytes += picture.size();
  }
  report_.textures.pictures += pictures.size();
  report_.textures.surfaces += tile.made.pieces;
  report_.textures.texels += tile.made.texels;
  for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
    ScenePrimitive& primitive = mesh.primitives[i];
    const MaterialCode code = primitive.material;
    report_.triangles[find_material(code).name] += primitive.indices.size() / 3;
    if (primitive.texture_coordinates.empty()) {
      primitive.material = materials_.find_index(code);
      continue;
    }
    report_.textures.triangles += primitive.indices.size() / 3;
    primitive.material = materials_.add_pictured(code, pictures[tile.made.picture_of_primitive[i]]);
  }
  writer_.add_node({mesh.name, name_of(tile.key.kind), writer_.add_mesh(mesh), true, {tile.place}});
}

void SceneTiles::count(const CoverCounts& cover) {
  for (std::size_t i = 0; i < cover.area_m2.size(); ++i)
    if (cover.area_m2[i] > 0)
      report_.cover_m2[ground_cover::ground_materials()[i].name] += cover.area_m2[i];
  report_.bare_m2 += cover.bare_m2;
  report_.cover_triangles += cover.triangles;
  report_.uncovered_tiles += cover.uncut_tiles;
}

std::uint32_t SceneTiles::add_feature(const city::CityObject& object) {
  SceneFeature feature{object.id, object.class_name, object.function, object.measured_height_m,
                       object.storeys_above_ground};
  if (feature.function.empty()) feature.function = object.usage;
  return writer_.add_feature(feature);
}

}  // namespace nightcity::bake
