#include "tools/bake/city/ground_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "formats/error.h"
#include "tools/bake/city/grid_ground.h"
#include "tools/bake/city/ground_heights.h"
#include "tools/bake/city/map_reach.h"
#include "tools/bake/city/meet_buildings.h"

namespace nightcity::bake {
namespace {

// Returns how a surface of an object counts in the terrain; nothing where it does not.
std::optional<terrain::SurfaceClass> find_surface_class(city::ObjectType type,
                                                        city::SurfaceType surface) {
  switch (type) {
    case city::ObjectType::relief:
      return terrain::SurfaceClass::terrain;
    case city::ObjectType::road:
    case city::ObjectType::railway:
      return terrain::SurfaceClass::road;
    case city::ObjectType::building:
      if (surface == city::SurfaceType::ground) return terrain::SurfaceClass::ground_surface;
      if (surface == city::SurfaceType::roof) return terrain::SurfaceClass::roof;
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

// Returns whether the object's surfaces are a part of the ground that is seen.
bool is_ground(city::ObjectType type) {
  switch (type) {
    case city::ObjectType::relief:
    case city::ObjectType::road:
    case city::ObjectType::railway:
    case city::ObjectType::water:
    case city::ObjectType::land_use:
      return true;
    default:
      return false;
  }
}

using Parts = std::array<mesh::TriangleMesh, 4>;  // of an object, by SurfaceClass

Parts split_by_class(const PreparedObject& prepared) {
  Parts parts;
  for (const mesh::MeshTriangle& triangle : prepared.mesh.triangles) {
    const auto surface_class = find_surface_class(prepared.object.type, triangle.surface);
    if (!surface_class) continue;
    mesh::TriangleMesh& part = parts[static_cast<std::size_t>(*surface_class)];
    const auto first = static_cast<std::uint32_t>(part.positions.size());
    for (const std::uint32_t v : triangle.vertex)
      part.positions.push_back(prepared.mesh.positions[v]);
    part.triangles.push_back({{first, first + 1, first + 2}, triangle.surface, 0});
  }
  return parts;
}

std::set<Tile> find_tiles(const mesh::TriangleMesh& mesh, double tile_m) {
  ObjectTiles tiles(tile_m);
  const auto for_each = [&](const auto& visit) {
    for (const mesh::MeshTriangle& triangle : mesh.triangles) {
      const auto& p = mesh.positions;
      visit({p[triangle.vertex[0]], p[triangle.vertex[1]], p[triangle.vertex[2]]});
    }
  };
  for_each([&](const glm::dvec3(&corners)[3]) { tiles.add(corners); });
  std::set<Tile> result;
  for_each([&](const glm::dvec3(&corners)[3]) { result.insert(tiles.find_tile(corners)); });
  return result;
}

// Returns the tiles that hold something, and those within `margin_m` of them.
std::set<Tile> widened(const std::set<Tile>& occupied, double tile_m, double margin_m) {
  const auto reach = static_cast<std::int32_t>(std::ceil(margin_m / tile_m));
  std::set<Tile> result;
  for (const Tile& tile : occupied)
    for (std::int32_t column = tile.column - reach; column <= tile.column + reach; ++column)
      for (std::int32_t row = tile.row - reach; row <= tile.row + reach; ++row)
        result.insert({column, row});
  return result;
}

}  // namespace

CityConsumer::Turn GroundBuilder::prepare(const std::shared_ptr<const PreparedObject>& prepared) {
  std::set<Tile> tiles;
  Parts parts;
  terrain::Outline outline;
  if (!prepared->lacks_heights) {
    tiles = find_tiles(prepared->mesh, options_.tile_m);
    parts = split_by_class(*prepared);
    if (options_.keeps_outline && is_ground(prepared->object.type)) outline.add(prepared->mesh);
  }
  return [this, prepared, parts = std::move(parts), tiles = std::move(tiles),
          outline = std::move(outline)](bool) {
    outline_.add(outline);
    if (!prepared->object.plant) {
      terrain_.add_points(prepared->object.points);
      report_.relief_points += prepared->object.points.size();
    }
    for (const city::Ring& line : prepared->object.lines) {
      report_.relief_points += line.size();
      if (!terrain_.add_break_line(line)) ++report_.lone_vertices;
    }
    occupied_.insert(tiles.begin(), tiles.end());
    if (!prepared->mesh.triangles.empty()) {
      const city::ObjectType type = prepared->object.type;
      report_.has_roads |= type == city::ObjectType::road;
      report_.has_bridges |= type == city::ObjectType::bridge;
      report_.has_land |= type == city::ObjectType::land_use || type == city::ObjectType::water;
    }
    for (std::size_t n = 0; n < parts.size(); ++n)
      if (!parts[n].triangles.empty())
        terrain_.add(parts[n], static_cast<terrain::SurfaceClass>(n));
  };
}

GroundReport GroundBuilder::build(const georeference::CityFrame& frame,
                                  const ShowGround& show_made) {
  const ShowGround show = [&](const mesh::TriangleMesh& mesh) {
    if (options_.keeps_outline) outline_.add(mesh);
    if (show_made) show_made(mesh);
  };
  const bool given = terrain_.has_relief();
  std::optional<terrain::Extent> reach;
  if (!places_.empty() && options_.map_reach_m > 0) {
    reach = find_reach(occupied_, options_.tile_m, places_, options_.map_reach_m);
    if (reach) {
      add_tiles(places_, *reach, options_.tile_m, occupied_);
      *reach = {reach->low - options_.margin_m, reach->high + options_.margin_m};
    }
  }
  if (!options_.elevation_models.empty() && !occupied_.empty()) {
    if (given) {
      report_.dem = "not used: the city brings its own relief";
    } else {
      report_.dem = build_dem_ground(frame, show);
      report_.source = "dem";
    }
  }
  terrain_.build(options_.margin_m, options_.max_error_m, reach);
  report_.break_edges = terrain_.break_edges();
  const bool surface = !terrain_.made_surface().triangles.empty();
  if (report_.source.empty())
    report_.source = given ? (surface ? "points" : "given") : surface ? "made" : "none";
  // Relief given as points is the model's own: it is shown whatever the options say about made
  // surfaces.
  report_.shown = given || report_.source == "dem" || (surface && options_.make_surface);
  if (surface && report_.shown) show(terrain_.made_surface());
  terrain_.drop_made_surface();
  if (!report_.shown) outline_ = {};
  return report_;
}

std::string GroundBuilder::build_dem_ground(const georeference::CityFrame& frame,
                                            const ShowGround& show) {
  GroundHeights heights(options_, frame);
  const std::string meeting = options_.carries_buildings
                                  ? "the map's buildings stand on it"
                                  : meet_buildings(heights, terrain_.footprint_points());
  const std::set<Tile> under = widened(occupied_, options_.tile_m, options_.margin_m);
  GridGround ground(heights, options_, under.size());
  const auto add = [&](const mesh::TriangleMesh& mesh) {
    terrain_.add(mesh, terrain::SurfaceClass::terrain);
    show(mesh);
  };
  for (const Tile& tile : under)
    if (const auto mesh = ground.make_whole(tile)) add(*mesh);
  if (ground.covers_nothing())
    throw Error(options_.elevation_models.front().string(),
                "no elevation model of the recipe covers any of the city" +
                    (heights.unplaced().empty() ? "" : "; " + heights.unplaced()));
  if (options_.make_surface) ground.fill_gaps(terrain_.footprint_points());
  for (const Tile& tile : ground.tiles_with_gaps()) add(ground.make_filled(tile));
  const std::string thinned =
      ground.thinned() == 0 ? ""
                            : fmt::format(", {} triangles fewer by max_error_m", ground.thinned());
  return fmt::format(
      "{} models, a height every {:.1f} m, {}, {:.1f} % of the ground without data{}{}{}",
      heights.count(), ground.step_m(), meeting, ground.missing_percent(),
      ground.is_filled() ? ", filled between its edges and the buildings' feet" : "", thinned,
      heights.assumptions());
}

}  // namespace nightcity::bake
