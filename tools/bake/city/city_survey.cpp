#include "tools/bake/city/city_survey.h"

#include <filesystem>
#include <glm/common.hpp>
#include <limits>
#include <numeric>
#include <utility>

#include "tools/bake/city/building_uses.h"
#include "tools/bake/city/city_frames.h"
#include "tools/bake/city/city_inputs.h"
#include "tools/inputs/read_city.h"
#include "tools/osm/read_osm.h"

namespace nightcity::bake {
namespace {

constexpr std::uint64_t cut_share = 256;            // of all bytes: smaller files are not cut
constexpr std::uint64_t min_cut_bytes = 64 * 1024;  // nor those

}  // namespace

PlanExtent find_extent(const CityInputs& inputs) {
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
  for (const auto& file : inputs.files)
    inputs::read_city(file, inputs.read, [&](city::CityObject&& object) {
      for (const city::Polygon& polygon : object.polygons)
        for (const glm::dvec3& p : polygon.exterior) {
          low = glm::min(low, glm::dvec2(p));
          high = glm::max(high, glm::dvec2(p));
        }
    });
  return {low, high};
}

CitySurvey survey_city(const CityInputs& inputs) {
  CitySurvey survey;
  survey.heads = CityFrames::read_heads(inputs);
  for (const auto& file : inputs.files) survey.sizes.push_back(std::filesystem::file_size(file));
  if (inputs.bounds) survey.extent = find_extent(inputs);
  osm::OsmData map = osm::read_osm(inputs.maps, static_cast<std::size_t>(inputs.max_way_nodes));
  survey.map_multipolygons = read_building_multipolygons(inputs, map);
  survey.map_buildings = std::move(map.buildings);
  const std::uint64_t all =
      std::accumulate(survey.sizes.begin(), survey.sizes.end(), std::uint64_t{0});
  survey.cuts.resize(inputs.files.size());
  if (inputs.read.reader != city::Reader::stream) return survey;
  for (std::size_t i = 0; i < inputs.files.size(); ++i)
    if (survey.sizes[i] >= min_cut_bytes && survey.sizes[i] * cut_share >= all)
      survey.cuts[i] = inputs::find_cuts(inputs.files[i]);
  return survey;
}

}  // namespace nightcity::bake
