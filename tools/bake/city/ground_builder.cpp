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
#include "tools/bake/city/ground_heights.h"
#include "tools/bake/city/map_reach.h"
#include "tools/bake/city/meet_buildings.h"
#include "tools/terrain/thin_surface.h"

namespace nightcity::bake {
namespace {

constexpr double max_quads = 1e6;  // of a ground from an elevation model

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

// A tile's ground: a regular grid of heights, two triangles a square.
class GridGround {
 public:
  GridGround(const GroundHeights& heights, const GroundOptions& options, std::size_t tiles)
      : heights_(heights), max_error_m_(options.max_error_m) {
    const double tile_m = options.tile_m;
    const double finest = std::ceil(tile_m / heights.finest_m()),
                 affordable = std::floor(std::sqrt(max_quads / static_cast<double>(tiles)));
    steps_ = static_cast<std::uint32_t>(std::clamp(std::min(finest, affordable), 1.0, 512.0));
    step_m_ = tile_m / steps_;
  }

  double step_m() const { return step_m_; }
  bool covers_nothing() const { return missing_ == quads_; }
  double missing_percent() const {
    return 100.0 * static_cast<double>(missing_) / static_cast<double>(quads_);
  }

  mesh::TriangleMesh make(const Tile& tile) {
    std::vector<glm::dvec2> places;
    // Counted from the frame's origin, so that neighbouring tiles have the very same vertices.
    const auto line = [&](std::int32_t number, std::uint32_t i) {
      return static_cast<double>(std::int64_t{number} * steps_ + i) * step_m_;
    };
    for (std::uint32_t j = 0; j <= steps_; ++j)
      for (std::uint32_t i = 0; i <= steps_; ++i)
        places.emplace_back(line(tile.column, i), line(tile.row, j));
    std::vector<double> z = heights_.at(places);
    const std::vector<bool> loose = straighten_sides(z);
    mesh::TriangleMesh mesh;
    for (std::size_t i = 0; i < places.size(); ++i)
      mesh.positions.emplace_back(places[i], z[i]);
    const std::size_t missing_before = missing_;
    for (std::uint32_t j = 0; j < steps_; ++j)
      for (std::uint32_t i = 0; i < steps_; ++i) {
        const std::uint32_t a = j * (steps_ + 1) + i, b = a + 1, c = b + steps_ + 1, d = c - 1;
        ++quads_;
        if (!std::isfinite(z[a] + z[b] + z[c] + z[d])) {
          ++missing_;
          continue;
        }
        mesh.triangles.push_back({{a, b, c}, city::SurfaceType::terrain, 0});
        mesh.triangles.push_back({{a, c, d}, city::SurfaceType::terrain, 0});
      }
    const std::size_t whole = mesh.triangles.size();
    // All vertices stay if data are missing: then the tile's outline does not follow its sides.
    if (max_error_m_ > 0 && missing_ == missing_before)
      mesh = terrain::thin_surface(mesh, max_error_m_, loose);
    thinned_ += whole - mesh.triangles.size();
    return mesh;
  }

  std::size_t thinned() const { return thinned_; }

 private:
  // Returns which vertices of the tile's sides are not needed, and puts them on the straight lines
  // between the others: so a neighbour meets this tile whether it uses them or not.
  std::vector<bool> straighten_sides(std::vector<double>& z) const {
    std::vector<bool> loose(z.size());
    if (!(max_error_m_ > 0)) return loose;
    const std::size_t row = steps_ + 1, last = steps_;
    for (const auto& [first, stride] :
         {std::pair<std::size_t, std::size_t>{0, 1}, {last * row, 1}, {0, row}, {last, row}}) {
      std::vector<double> side;
      for (std::size_t n = 0; n < row; ++n) side.push_back(z[first + n * stride]);
      if (std::any_of(side.begin(), side.end(), [](double h) { return !std::isfinite(h); }))
        continue;
      const std::vector<bool> needed = terrain::find_needed(side, max_error_m_);
      for (std::size_t from = 0, to = 1; to < row; ++to) {
        if (!needed[to]) continue;
        for (std::size_t n = from + 1; n < to; ++n) {
          const double share = static_cast<double>(n - from) / static_cast<double>(to - from);
          z[first + n * stride] = side[from] + share * (side[to] - side[from]);
          loose[first + n * stride] = true;
        }
        from = to;
      }
    }
    return loose;
  }

  const GroundHeights& heights_;
  double max_error_m_;
  double step_m_ = 0;
  std::uint32_t steps_ = 1;  // squares along a tile's side
  std::size_t quads_ = 0, missing_ = 0;
  std::size_t thinned_ = 0;  // triangles
};

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
  for (const Tile& tile : under) {
    const mesh::TriangleMesh mesh = ground.make(tile);
    terrain_.add(mesh, terrain::SurfaceClass::terrain);
    show(mesh);
  }
  if (ground.covers_nothing())
    throw Error(options_.elevation_models.front().string(),
                "no elevation model of the recipe covers any of the city" +
                    (heights.unplaced().empty() ? "" : "; " + heights.unplaced()));
  const std::string thinned =
      ground.thinned() == 0 ? ""
                            : fmt::format(", {} triangles fewer by max_error_m", ground.thinned());
  return fmt::format(
      "{} models, a height every {:.1f} m, {}, {:.1f} % of the ground without data{}{}",
      heights.count(), ground.step_m(), meeting, ground.missing_percent(), thinned,
      heights.assumptions());
}

}  // namespace nightcity::bake
