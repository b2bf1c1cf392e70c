#include "tools/bake/stages/traffic_stage.h"

#include <algorithm>
#include <string>

namespace nightcity::bake {
namespace {

// Returns the height for wheels: they stand on the ground as it is covered, or on a road that lies
// on it.
place::HeightAt road_height_on(const City& city) {
  constexpr double max_above_ground_m = 0.6;  // a road higher up is a bridge
  return [&city](const glm::dvec2& place) -> std::optional<double> {
    const terrain::Terrain& terrain = city.terrain();
    const auto ground = terrain.height_at(place);
    if (!ground || ground->surface == terrain::SurfaceClass::roof) return std::nullopt;
    const auto road = terrain.height_of(terrain::SurfaceClass::road, place);
    if (road && *road > ground->height_m && *road < ground->height_m + max_above_ground_m)
      return *road;
    const bool covered = ground->surface == terrain::SurfaceClass::terrain;
    return ground->height_m - (covered ? city.cover().depth_at(place) : 0);
  };
}

// Roads that were published without heights, in a model without any ground: a bake leaves them at
// height 0, so traffic stays there too.
bool lacks_ground(const City& city) {
  if (!city.inputs().maps.empty()) return false;
  const auto has_ground = [&](const osm::OsmWay& way) {
    return std::any_of(way.lon_lat.begin(), way.lon_lat.end(), [&](const glm::dvec2& lon_lat) {
      return city.terrain().height_at(city.frame().from_lon_lat(lon_lat)).has_value();
    });
  };
  return std::none_of(city.map().highways.begin(), city.map().highways.end(), has_ground);
}

}  // namespace

traffic::TrafficSet make_city_traffic(const City& city, const traffic::TrafficOptions& options,
                                      const Georeference& georeference,
                                      const ProgressSink& progress) {
  if (city.map().highways.empty() && city.has_model()) return {};
  city.require_lon_lat("streets cannot be placed");
  const bool flat = !city.has_model() || lacks_ground(city);
  const place::HeightAt height_at =
      flat ? place::HeightAt([](const glm::dvec2&) { return std::optional(0.0); })
           : road_height_on(city);
  return traffic::make_traffic(
      city.map().highways, city.to_frame(), height_at, city.inside_footprint(), options,
      georeference,
      [&](const char* step, double share) {
        if (progress)
          progress(
              {std::string("traffic: ") + step, static_cast<std::size_t>(share * 100), "%", 100});
      },
      city.bridges().deck_at());
}

TrafficAddition to_addition(const traffic::TrafficSet& traffic) {
  return {traffic.content(), traffic.profiles.profiles, traffic.profiles.data};
}

}  // namespace nightcity::bake
