#include "tools/bake/city/model_streets.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace nightcity {

bool wants_model_streets(const Recipe& recipe, const OsmData& osm, const CityFrames& frames) {
  const bool along_streets =
      recipe.traffic.drives || recipe.lamps.layout.mode != layout::LayoutOptions::Mode::never;
  return osm.highways.empty() && along_streets && frames.city().has_lon_lat();
}

StreetReport add_model_streets(const streets::RoadSurfaces& roads, const CityFrames& frames,
                               OsmData& osm) {
  streets::StreetWays streets =
      streets::street_ways(roads, [&](const glm::dvec2& p) { return frames.city().to_lon_lat(p); });
  for (OsmWay& way : streets.ways) osm.highways.push_back(std::move(way));
  return {roads.surfaces().size(), roads.left_out(),  streets.km,
          streets.km_by_code,      streets.junctions, streets.ends};
}

nlohmann::json to_json(const StreetReport& report) {
  return {{"surfaces", report.surfaces},
          {"polygons_left_out", report.left_out},
          {"km", report.km},
          {"km_classed_by_code", report.km_by_code},
          {"junctions", report.junctions},
          {"ends", report.ends}};
}

std::string to_text(const StreetReport& report) {
  if (report.surfaces == 0) return {};
  double sum = 0;
  std::string classes;
  for (const auto& [highway, km] : report.km) {
    sum += km;
    classes += fmt::format("{}{} {:.1f}", classes.empty() ? "" : ", ", highway, km);
  }
  return fmt::format(
      "{:<12}{:.1f} km in the middle of {} road surfaces of the model: {} ({:.1f} km by code, else "
      "by "
      "width); {} "
      "junctions, {} ends\n",
      "streets", sum, report.surfaces, classes, report.km_by_code, report.junctions, report.ends);
}

}  // namespace nightcity
