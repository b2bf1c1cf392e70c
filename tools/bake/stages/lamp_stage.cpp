#include "tools/bake/stages/lamp_stage.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "formats/error.h"
#include "tools/lights/lamp_hours.h"
#include "tools/lights/luminaire.h"

namespace nightcity {

HeightAt height_on(const Terrain& terrain) {
  return [&terrain](const glm::dvec2& place) -> std::optional<double> {
    const auto hit = terrain.height_at(place);
    return hit && hit->footing != Footing::roof ? std::optional(hit->height_m) : std::nullopt;
  };
}

LampOptions lamp_options(const Recipe::Lamps& lamps) {
  LampOptions options;
  for (const Recipe::Lamps::LuminaireFile& choice : lamps.luminaires) {
    const Luminaire luminaire = read_luminaire(choice.file);
    options.luminaires.push_back({choice.file.string(), luminaire.photometry(), choice.highways,
                                  choice.types, choice.take_flux, luminaire.flux_lm});
  }
  return options;
}

namespace {

/// The lamps of a map in a frame, on a ground.
CityLamps place_on(const Recipe& recipe, const OsmData& osm, const CityFrame& frame,
                   const HeightAt& height, const InsideBuilding& inside, LampOptions luminaires) {
  using Mode = layout::LayoutOptions::Mode;
  const layout::LayoutOptions& options = recipe.lamps.layout;
  const auto to_frame = [&](const glm::dvec2& lon_lat) { return frame.from_lon_lat(lon_lat); };
  CityLamps result;
  if (options.mode == Mode::always)
    result.set.dropped["mapped, but [lamps] layout = \"always\""] = osm.lamps.size();
  else
    result.set = place_lamps(osm, to_frame, height, inside, luminaires);
  if (options.mode != Mode::never && !osm.highways.empty())
    result.layout =
        layout::lay_out_lamps(osm, to_frame, height, inside, luminaires, options, result.set);
  switch_lamps(recipe.lamps.hours, result.set);
  return result;
}

glm::dvec2 middle_of(const OsmData& osm) {
  std::vector<double> lon, lat;
  const auto add = [&](const glm::dvec2& p) {
    lon.push_back(p.x);
    lat.push_back(p.y);
  };
  for (const OsmLampNode& lamp : osm.lamps) add(lamp.lon_lat);
  if (lon.empty())
    for (const OsmWay& way : osm.highways)
      if (!way.lon_lat.empty()) add(way.lon_lat.front());
  if (lon.empty()) throw Error("", "the map has neither lamps nor streets");
  const auto median = [](std::vector<double>& values) {
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    return *half;
  };
  return {median(lon), median(lat)};
}

std::string utm_zone(const glm::dvec2& lon_lat) {
  const int zone = std::clamp(static_cast<int>(std::floor((lon_lat.x + 180) / 6)) + 1, 1, 60);
  return "EPSG:" + std::to_string((lon_lat.y < 0 ? 32700 : 32600) + zone);
}

}  // namespace

CityLamps place_city_lamps(const Recipe& recipe, const OsmData& osm, const CityFrames& frames,
                           const Terrain& terrain) {
  const LampOptions luminaires = lamp_options(recipe.lamps);
  const bool lay_out =
      recipe.lamps.layout.mode != layout::LayoutOptions::Mode::never && !osm.highways.empty();
  if (osm.lamps.empty() && !lay_out) return {};
  if (!frames.city().has_lon_lat())
    throw Error("", "[city] crs",
                "the city names no CRS: lamps cannot be placed without crs or control_points");
  const auto inside = [&](const glm::dvec2& p) {
    return terrain.height_of(Footing::ground_surface, p).has_value();
  };
  return place_on(recipe, osm, frames.city(), height_on(terrain), inside, luminaires);
}

MapFrame::MapFrame(const OsmData& osm)
    : middle(middle_of(osm)), frame(CityFrame::from_srs_name(utm_zone(middle), {}, {})) {}

Georeference MapFrame::georeference(const Recipe& recipe) const {
  Georeference result;
  result.crs = frame.crs();
  const glm::dvec2 origin = glm::round(frame.from_lon_lat(middle));
  result.origin = {origin.x, origin.y, 0};
  for (const auto& file : recipe.osm.files) result.sources.push_back(file.filename().string());
  result.licences = {recipe.osm.licence};
  return result;
}

CityLamps place_map_lamps(const Recipe& recipe, const OsmData& osm, const CityFrame& frame) {
  LampOptions options = lamp_options(recipe.lamps);
  options.heights_from_tags = true;
  const HeightAt flat = [](const glm::dvec2&) { return std::optional(0.0); };
  return place_on(recipe, osm, frame, flat, {}, std::move(options));
}

}  // namespace nightcity
