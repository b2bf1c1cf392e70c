#include "tools/bake/city/ground_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "tools/bake/city/city_reader.h"
#include "tools/terrain/elevation_model.h"

namespace nightcity {
namespace {

constexpr double max_quads = 1e6;  // of a ground from an elevation model
constexpr std::size_t max_feet = 20'000;

using Tile = std::pair<std::int32_t, std::int32_t>;

// The elevation models asked in the city's coordinates: the first that has a height says it.
class Heights {
 public:
  Heights(const Recipe& recipe, const CityFrames& frames) : city_(frames.city()) {
    for (const auto& file : recipe.terrain.dem) {
      models_.emplace_back(file);
      if (models_.back().has_crs() && !city_.has_lon_lat())
        throw Error(file.string(), "cannot be laid under a city that names no CRS: set [city] crs");
      finest_ = std::min(finest_, models_.back().resolution_m());
    }
  }

  double finest_m() const { return finest_; }

  std::vector<double> at(std::span<const glm::dvec2> places) const {
    std::vector<double> heights(places.size(), std::numeric_limits<double>::quiet_NaN()),
        next(places.size());
    std::vector<glm::dvec2> lon_lat;
    for (const ElevationModel& model : models_) {
      if (std::none_of(heights.begin(), heights.end(), [](double h) { return std::isnan(h); }))
        break;
      if (model.has_crs() && lon_lat.empty())
        for (const glm::dvec2& p : places) lon_lat.push_back(city_.to_lon_lat(p));
      model.sample(model.has_crs() ? std::span<const glm::dvec2>(lon_lat) : places, next);
      for (std::size_t i = 0; i < heights.size(); ++i)
        if (std::isnan(heights[i])) heights[i] = next[i];
    }
    return heights;
  }

 private:
  const CityFrame& city_;
  std::vector<ElevationModel> models_;
  double finest_ = std::numeric_limits<double>::infinity();
};

// The tiles that hold something, and those within `margin_m` of them.
std::set<Tile> ground_tiles(TileStore& tiles, double tile_m, double margin_m) {
  const auto reach = static_cast<std::int32_t>(std::ceil(margin_m / tile_m));
  std::set<Tile> result;
  for (const TileKey& key : tiles.tiles())
    for (std::int32_t column = key.column - reach; column <= key.column + reach; ++column)
      for (std::int32_t row = key.row - reach; row <= key.row + reach; ++row)
        result.insert({column, row});
  return result;
}

// Elevation models and city models differ in what height they count from (geoid, ellipsoid, a national datum)
// and by the model's own error: the median over the buildings' feet takes that out.
double shift_to_city(const Heights& heights, const Terrain& terrain) {
  const auto& feet = terrain.feet();
  std::vector<double> differences;
  const std::size_t stride = std::max<std::size_t>(1, feet.size() / max_feet);
  std::vector<glm::dvec3> some;
  for (std::size_t i = 0; i < feet.size(); i += stride) some.push_back(feet[i]);
  std::sort(some.begin(), some.end(), [](const glm::dvec3& a, const glm::dvec3& b) {
    return std::make_pair(std::floor(a.x / 500), a.y) < std::make_pair(std::floor(b.x / 500), b.y);
  });
  constexpr std::size_t together = 500;  // places that lie together are read together
  std::vector<glm::dvec2> places;
  for (std::size_t begin = 0; begin < some.size(); begin += together) {
    const std::size_t end = std::min(some.size(), begin + together);
    places.assign(some.begin() + static_cast<std::ptrdiff_t>(begin),
                  some.begin() + static_cast<std::ptrdiff_t>(end));
    const std::vector<double> dem = heights.at(places);
    for (std::size_t i = 0; i < dem.size(); ++i)
      if (std::isfinite(dem[i])) differences.push_back(some[begin + i].z - dem[i]);
  }
  if (differences.empty()) return 0;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return *middle;
}

std::string lay_dem(const Recipe& recipe, const CityFrames& frames, Terrain& terrain,
                    TileStore& tiles) {
  const Heights heights(recipe, frames);
  const double size = recipe.city.tile_m, shift = shift_to_city(heights, terrain);
  const std::set<Tile> under = ground_tiles(tiles, size, recipe.terrain.margin_m);
  const double finest = std::ceil(size / heights.finest_m()),
               affordable = std::floor(std::sqrt(max_quads / static_cast<double>(under.size())));
  const auto steps =
      static_cast<std::uint32_t>(std::clamp(std::min(finest, affordable), 1.0, 512.0));
  const double step_m = size / steps;
  std::size_t quads = 0, missing = 0;
  for (const auto& [column, row] : under) {
    std::vector<glm::dvec2> places;
    // Counted from the frame's origin, so that neighbouring tiles have the very same vertices.
    const auto line = [&](std::int32_t tile, std::uint32_t i) {
      return static_cast<double>(std::int64_t{tile} * steps + i) * step_m;
    };
    for (std::uint32_t j = 0; j <= steps; ++j)
      for (std::uint32_t i = 0; i <= steps; ++i) places.emplace_back(line(column, i), line(row, j));
    const std::vector<double> z = heights.at(places);
    TriangleMesh mesh;
    for (std::size_t i = 0; i < places.size(); ++i)
      mesh.positions.emplace_back(places[i], z[i] + shift);
    for (std::uint32_t j = 0; j < steps; ++j)
      for (std::uint32_t i = 0; i < steps; ++i) {
        const std::uint32_t a = j * (steps + 1) + i, b = a + 1, c = b + steps + 1, d = c - 1;
        ++quads;
        if (!std::isfinite(z[a] + z[b] + z[c] + z[d])) {
          ++missing;
          continue;
        }
        mesh.triangles.push_back({{a, b, c}, SurfaceType::terrain, 0});
        mesh.triangles.push_back({{a, c, d}, SurfaceType::terrain, 0});
      }
    terrain.add(mesh, Footing::terrain);
    add_mesh(tiles, mesh, ObjectType::relief, no_id);
  }
  if (missing == quads)
    throw Error(recipe.terrain.dem.front().string(),
                "no elevation model of the recipe covers any of the city");
  return fmt::format(
      "{} models, a height every {:.1f} m, moved by {:+.2f} m to meet the buildings, {:.1f} % of "
      "the ground without data",
      recipe.terrain.dem.size(), step_m, shift,
      100.0 * static_cast<double>(missing) / static_cast<double>(quads));
}

}  // namespace

GroundReport lay_ground(const Recipe& recipe, const CityFrames& frames, Terrain& terrain,
                        TileStore& tiles) {
  GroundReport report;
  const bool given = terrain.has_relief();
  if (!recipe.terrain.dem.empty() && !tiles.tiles().empty()) {
    if (given) {
      report.dem = "not used: the city brings its own relief";
    } else {
      report.dem = lay_dem(recipe, frames, terrain, tiles);
      report.source = "dem";
    }
  }
  terrain.build(recipe.terrain.margin_m);
  report.break_edges = terrain.break_edges();
  const bool surface = !terrain.made_surface().triangles.empty();
  if (report.source.empty())
    report.source = given ? (surface ? "points" : "given") : surface ? "made" : "none";
  // Relief given as points is the model's own: it is shown whatever the recipe says of made surfaces.
  if (surface && (given || recipe.terrain.make_surface))
    add_mesh(tiles, terrain.made_surface(), ObjectType::relief, no_id);
  terrain.drop_made_surface();
  return report;
}

}  // namespace nightcity
