#include "tools/elevation/elevate.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "formats/median.h"

namespace nightcity::elevation {
namespace {

constexpr std::size_t min_samples = 3;
constexpr std::size_t max_samples = 60;  // places that the service is asked for to find its offset
constexpr double same_place_degrees = 0.3 / 111'000;

HeightOffset find_offset(const std::vector<double>& differences) {
  HeightOffset offset;
  offset.samples = differences.size();
  if (differences.size() < min_samples) return offset;
  offset.metres = median(differences);
  std::vector<double> deviations;
  for (const double difference : differences)
    deviations.push_back(std::abs(difference - offset.metres));
  offset.deviation = median(std::move(deviations));
  return offset;
}

const char* name_of(terrain::SurfaceClass surface_class) {
  constexpr const char* names[] = {"terrain", "road", "building ground", "roof"};
  return names[static_cast<int>(surface_class)];
}

/// Counts lamps within a third of a metre of another.
std::size_t count_duplicates(const std::vector<osm::OsmLampNode>& lamps) {
  std::unordered_set<std::uint64_t> places;
  std::size_t duplicates = 0;
  for (const osm::OsmLampNode& lamp : lamps) {
    const double shrink = std::max(0.01, std::cos(lamp.lon_lat.y * 0.017453292519943295));
    const auto x =
        static_cast<std::int64_t>(std::llround(lamp.lon_lat.x * shrink / same_place_degrees));
    const auto y = static_cast<std::int64_t>(std::llround(lamp.lon_lat.y / same_place_degrees));
    duplicates +=
        !places.insert(static_cast<std::uint64_t>(x) << 32 ^ static_cast<std::uint32_t>(y)).second;
  }
  return duplicates;
}

}  // namespace

Elevations elevate_lamps(const std::vector<osm::OsmLampNode>& lamps,
                         const ElevationSources& sources) {
  Elevations result;
  result.duplicates = count_duplicates(lamps);
  std::vector<std::size_t> open;
  std::vector<std::size_t> known;  // by the model
  for (std::size_t n = 0; n < lamps.size(); ++n) {
    std::optional<terrain::Terrain::Hit> hit;
    if (sources.terrain) {
      const glm::dvec2 place = sources.to_frame(lamps[n].lon_lat);
      hit = sources.terrain->height_at(place);
      if (hit && sources.terrain->inside_building(place)) ++result.inside_buildings;
      if (!hit) ++result.outside_model;
    }
    if (hit) {
      result.heights[lamps[n].id] = hit->height_m;
      ++result.sources[name_of(hit->surface)];
      known.push_back(n);
    } else {
      open.push_back(n);
    }
  }

  if (sources.dem) {
    std::vector<double> differences;
    for (const std::size_t n : known)
      if (const auto height = sources.dem->height_at(lamps[n].lon_lat))
        differences.push_back(result.heights[lamps[n].id] - *height);
    result.raster_offset = find_offset(differences);
    std::vector<std::size_t> still_open;
    for (const std::size_t n : open)
      if (const auto height = sources.dem->height_at(lamps[n].lon_lat)) {
        result.heights[lamps[n].id] = *height + result.raster_offset.metres;
        ++result.sources["raster"];
      } else {
        still_open.push_back(n);
      }
    open = std::move(still_open);
  }

  if (sources.service && !open.empty()) {
    // Evenly among the lamps whose height is known, so that the samples cover the model.
    std::vector<std::size_t> asked = open;
    const std::size_t step =
        std::max<std::size_t>(1, (known.size() + max_samples - 1) / max_samples);
    for (std::size_t k = 0; k < known.size(); k += step) asked.push_back(known[k]);
    std::vector<glm::dvec2> places;
    for (const std::size_t n : asked) places.push_back(lamps[n].lon_lat);
    result.service = ask_elevations(places, *sources.service);
    std::vector<double> differences;
    for (std::size_t k = open.size(); k < asked.size(); ++k)
      if (result.service.heights[k])
        differences.push_back(result.heights[lamps[asked[k]].id] - *result.service.heights[k]);
    result.service_offset = find_offset(differences);
    std::vector<std::size_t> still_open;
    for (std::size_t k = 0; k < open.size(); ++k)
      if (result.service.heights[k]) {
        result.heights[lamps[open[k]].id] =
            *result.service.heights[k] + result.service_offset.metres;
        ++result.sources["service"];
      } else {
        still_open.push_back(open[k]);
      }
    open = std::move(still_open);
  }
  if (!open.empty()) result.sources["nothing"] = open.size();
  return result;
}

}  // namespace nightcity::elevation
