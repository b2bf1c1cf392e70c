#include "tools/bake/lamp_stage.h"

#include "formats/error.h"

namespace nightcity {

HeightAt height_on(const Terrain& terrain) {
  return [&terrain](const glm::dvec2& place) -> std::optional<double> {
    const auto hit = terrain.height_at(place);
    return hit ? std::optional(hit->height_m) : std::nullopt;
  };
}

CityLamps place_city_lamps(const Recipe& recipe, const OsmData& osm, const CityFrames& frames,
                           const Terrain& terrain) {
  using Mode = layout::LayoutOptions::Mode;
  const layout::LayoutOptions& options = recipe.lamps.layout;
  const bool lay_out = options.mode != Mode::never && !osm.highways.empty();
  CityLamps result;
  if (osm.lamps.empty() && !lay_out) return result;
  if (!frames.city().has_lon_lat())
    throw Error("", "[city] crs",
                "the city names no CRS: lamps cannot be placed without crs or control_points");
  const auto to_frame = [&](const glm::dvec2& lon_lat) { return frames.city().from_lon_lat(lon_lat); };
  const auto inside = [&](const glm::dvec2& p) { return terrain.inside_building(p); };
  const HeightAt height = height_on(terrain);
  if (options.mode == Mode::always)
    result.set.dropped["mapped, but [lamps] layout = \"always\""] = osm.lamps.size();
  else
    result.set = place_lamps(osm, to_frame, height, inside);
  if (lay_out) result.layout = layout::lay_out_lamps(osm, to_frame, height, inside, {}, options, result.set);
  return result;
}

}  // namespace nightcity
