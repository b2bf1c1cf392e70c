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
#include "tools/terrain/made_surface.h"

namespace nightcity::bake {
namespace {

// Parks and rivers that part a city are up to twice as wide.
constexpr double between_m = 500;

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

// Returns the tiles of a ground on elevation models: those within `margin_m` of the city, and of
// those between them the ones within `between_m`, all inside one rectangle.
std::set<Tile> find_ground_tiles(const std::set<Tile>& occupied, double tile_m, double margin_m) {
  std::set<Tile> result = widened(occupied, tile_m, margin_m);
  const auto [west, east] = std::pair(result.begin()->column, result.rbegin()->column);
  const auto by_row = [](const Tile& a, const Tile& b) { return a.row < b.row; };
  const auto [southmost, northmost] = std::minmax_element(result.begin(), result.end(), by_row);
  const std::int32_t south = southmost->row, north = northmost->row;
  for (const Tile& tile : widened(occupied, tile_m, between_m))
    if (tile.column >= west && tile.column <= east && tile.row >= south && tile.row <= north)
      result.insert(tile);
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
    if (needs_outline() && is_ground(prepared->object.type)) outline.add(prepared->mesh);
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
    if (needs_outline()) outline_.add(mesh);
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
  const std::vector<glm::dvec3> feet =
      given ? terrain_.footprint_points() : std::vector<glm::dvec3>();
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
  if (given && options_.make_surface) go_beyond_relief(frame, feet, show);
  if (!report_.shown || !options_.keeps_outline) outline_ = {};
  return report_;
}

// A model may bring the relief of a part of itself: some of a survey's tiles, a single site.
void GroundBuilder::go_beyond_relief(const georeference::CityFrame& frame,
                                     std::span<const glm::dvec3> feet, const ShowGround& show) {
  const auto has_ground = [&](const glm::dvec3& p) {
    return terrain_.height_of(terrain::SurfaceClass::terrain, p) ||
           terrain_.height_of(terrain::SurfaceClass::road, p);
  };
  std::vector<glm::dvec3> beyond;
  std::copy_if(feet.begin(), feet.end(), std::back_inserter(beyond),
               [&](const glm::dvec3& foot) { return !has_ground(foot); });
  // Few are those of buildings that reach over the edge of a complete relief.
  const double few = 0.01 * static_cast<double>(feet.size());
  if (static_cast<double>(beyond.size()) <= few) return;
  const auto rings = outline_.find_rings();
  terrain::SurfaceAround around = terrain::make_surface_around(rings, beyond, options_.margin_m);
  const auto outside = static_cast<double>(around.points);
  if (outside <= few) return;  // the others stand in holes of the relief
  if (!options_.elevation_models.empty()) {
    report_.dem = add_heights(frame, feet, has_ground, beyond);
    around = terrain::make_surface_around(rings, std::move(beyond), options_.margin_m);
  }
  terrain_.add(around.mesh, terrain::SurfaceClass::terrain);
  show(around.mesh);
  report_.beyond_relief_percent = 100 * outside / static_cast<double>(feet.size());
}

// Puts the heights of elevation models in the place of feet, where there are any and no ground.
std::string GroundBuilder::add_heights(const georeference::CityFrame& frame,
                                       std::span<const glm::dvec3> feet,
                                       const std::function<bool(const glm::dvec3&)>& has_ground,
                                       std::vector<glm::dvec3>& beyond) const {
  GroundHeights heights(options_, frame);
  const std::string meeting = meet_buildings(heights, {feet.begin(), feet.end()});
  const std::vector<double> known =
      heights.at(std::vector<glm::dvec2>(beyond.begin(), beyond.end()));
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < beyond.size(); ++i)
    if (!std::isfinite(known[i])) points.push_back(beyond[i]);
  const std::set<Tile> under = find_ground_tiles(occupied_, options_.tile_m, options_.margin_m);
  const GridGround grid(heights, options_, under.size());
  for (const Tile& tile : under)
    for (const glm::dvec3& p : grid.find_heights(tile))
      if (std::isfinite(p.z) && !has_ground(p)) points.push_back(p);
  beyond = std::move(points);
  return fmt::format("beyond the city's own relief, {} models, a height every {:.1f} m, {}{}",
                     heights.count(), grid.step_m(), meeting, heights.assumptions());
}

std::string GroundBuilder::build_dem_ground(const georeference::CityFrame& frame,
                                            const ShowGround& show) {
  GroundHeights heights(options_, frame);
  const std::string meeting = options_.carries_buildings
                                  ? "the map's buildings stand on it"
                                  : meet_buildings(heights, terrain_.footprint_points());
  const std::set<Tile> under = find_ground_tiles(occupied_, options_.tile_m, options_.margin_m);
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
