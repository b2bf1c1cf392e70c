// The place of a city: its frame, that of its map where it has no model, and its origin.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <string>
#include <utility>

#include "formats/error.h"
#include "formats/median.h"
#include "tools/bake/city/city.h"
#include "tools/georeference/utm_zone.h"
#include "tools/place/longitude.h"

namespace nightcity::bake {
namespace {

void add_names(const std::vector<std::filesystem::path>& files, std::vector<std::string>& names) {
  for (const auto& file : files) names.push_back(file.filename().string());
}

// Places of lights are floats: 100 km from the origin these are 8 mm apart, and windows stand 2 cm
// before their walls. An origin beyond that is moved in whole steps, so that neighbouring bakes
// with the same one share the moved one as well, or differ by whole steps.
constexpr double max_from_origin_m = 100'000, origin_step_m = 50'000;

double keep_near(const std::optional<double>& asked, double place) {
  if (!asked) return std::round(place);
  const double away = place - *asked;
  return std::abs(away) <= max_from_origin_m
             ? *asked
             : *asked + std::round(away / origin_step_m) * origin_step_m;
}

}  // namespace

void City::report_moved_origin() const {
  const glm::dvec3& place = frames_->reference();
  const auto report = [&](const char* key, const std::optional<double>& asked, double at) {
    if (const double kept = keep_near(asked, at); asked && kept != *asked)
      fmt::print(
          stderr,
          "note: {}: [origin] {} = {:.3f} is {:.0f} km from the city, where places of lights "
          "would be rounded to {:.2g} m: model space begins at {:.3f} instead, and "
          "georeferences say so\n",
          inputs_.name(), key, *asked, std::abs(at - *asked) / 1000, std::abs(at - *asked) * 1.2e-7,
          kept);
  };
  report("easting", inputs_.origin_easting, place.x);
  report("northing", inputs_.origin_northing, place.y);
  report("height", inputs_.origin_height, place.z);
}

// The frame is that of the middle of the lamps, else of the first points of the streets.
std::optional<City::MapFrame> City::find_map_frame(const osm::OsmData& map) {
  std::vector<double> lon, lat;
  const auto add = [&](const glm::dvec2& p) {
    lon.push_back(place::count_on(p.x, lon.empty() ? p.x : lon.front()));
    lat.push_back(p.y);
  };
  for (const osm::OsmLampNode& lamp : map.lamps) add(lamp.lon_lat);
  if (lon.empty())
    for (const osm::OsmWay& way : map.highways)
      if (!way.lon_lat.empty()) add(way.lon_lat.front());
  if (lon.empty()) return std::nullopt;
  const glm::dvec2 middle(median(std::move(lon)), median(std::move(lat)));
  return MapFrame{
      middle, georeference::CityFrame::from_srs_name(georeference::find_utm_zone(middle), {}, {})};
}

const CityFrames& City::frames() const {
  if (!frames_)
    throw UsageError(inputs_.name(), "names no city: [city] files = [\"...\"] is missing");
  return *frames_;
}

const georeference::CityFrame& City::frame() const {
  if (frames_) return frames_->city();
  if (!map_frame_) throw Error(inputs_.name(), "the map has neither lamps nor streets");
  return map_frame_->frame;
}

void City::require_lon_lat(const std::string& consequence) const {
  if (!frame().has_lon_lat())
    throw Error(inputs_.name(), "[city] crs",
                "the city names no CRS: " + consequence + " without crs or control_points");
}

Georeference City::georeference(const std::optional<glm::dvec2>& middle) const {
  Georeference result;
  result.crs = frame().crs();
  if (!inputs_.is_map_alone()) add_names(inputs_.files, result.sources);
  add_names(inputs_.maps, result.sources);
  for (const auto& inventory : inputs_.inventories) add_names({inventory.file}, result.sources);
  if (!has_model()) {
    const glm::dvec2 origin = glm::round(frame().from_lon_lat(map_frame_->middle));
    result.origin = {origin.x, origin.y, 0};
    result.licences = {inputs_.map_licence};
    add_inventory_licences(result.licences);
    return result;
  }
  const glm::dvec3& reference = frames_->reference();
  const glm::dvec2 plan = middle.value_or(glm::dvec2(reference));
  // An origin that is asked for is held against the same place by every stage.
  result.origin = {
      inputs_.origin_easting ? keep_near(inputs_.origin_easting, reference.x) : std::round(plan.x),
      inputs_.origin_northing ? keep_near(inputs_.origin_northing, reference.y)
                              : std::round(plan.y),
      keep_near(inputs_.origin_height, reference.z)};
  result.licences = inputs_.licences;
  if (!inputs_.maps.empty()) result.licences.push_back(inputs_.map_licence);
  add_inventory_licences(result.licences);
  return result;
}

void City::add_inventory_licences(std::vector<std::string>& licences) const {
  for (const inventory::InventoryFile& file : inputs_.inventories)
    if (!file.licence.empty() &&
        std::find(licences.begin(), licences.end(), file.licence) == licences.end())
      licences.push_back(file.licence);
}

place::LonLatToFrame City::to_frame() const {
  return [this](const glm::dvec2& lon_lat) { return frame().from_lon_lat(lon_lat); };
}

}  // namespace nightcity::bake
