#include "tools/bake/stages/places_stage.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "formats/json_text.h"
#include "formats/scene_places_json.h"
#include "tools/georeference/fit_degrees.h"
#include "tools/names/find_named_streets.h"

namespace nightcity::bake {
namespace {

void add_degrees(const City& city, const terrain::Extent& extent, PlacesOfCity& out) {
  const auto to_lon_lat = [&](const glm::dvec2& plane) { return city.frame().to_lon_lat(plane); };
  georeference::DegreesFit found = georeference::fit_degrees(to_lon_lat, extent.low, extent.high);
  if (found.fit)
    out.report.degrees_error_m = found.error_m;
  else
    out.report.why_no_degrees =
        fmt::format("no polynomial is within {:g} m of what PROJ says", georeference::max_fit_m);
  out.places.geographic = std::move(found.fit);
}

void add_streets(const City& city, const terrain::Extent& extent, const Georeference& georeference,
                 PlacesOfCity& out) {
  const std::vector<osm::MapArea> squares = city.read_squares();
  const osm::OsmData& map = city.map();
  names::NamedStreets found =
      names::find_named_streets({map.highways, squares, map.squares}, city.to_frame(),
                                {extent.low, extent.high}, georeference);
  out.report.names = found.names;
  out.report.streets = found.streets.size();
  out.report.points = found.points;
  out.report.other_names = found.other_names;
  out.report.left_out = std::move(found.left_out);
  out.places.streets = std::move(found.streets);
}

std::size_t count_bytes(const ScenePlaces& places) {
  nlohmann::json json = nlohmann::json::object();
  add_to_json(places, json);
  return dump(json).size();
}

}  // namespace

PlacesOfCity find_places(const City& city, const terrain::Extent& extent,
                         const Georeference& georeference) {
  PlacesOfCity out;
  if (!city.frame().has_lon_lat()) {
    out.report.why_no_degrees = "the city names no CRS";
    return out;
  }
  add_degrees(city, extent, out);
  add_streets(city, extent, georeference, out);
  out.report.bytes = count_bytes(out.places);
  return out;
}

}  // namespace nightcity::bake
