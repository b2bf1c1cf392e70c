#include "tools/bake/city/building_uses.h"

#include <cstddef>
#include <memory>
#include <set>
#include <string>

#include "tools/bake/city/city_survey.h"
#include "tools/lights/osm_uses.h"
#include "tools/map_buildings/file_buildings.h"
#include "tools/osm/lifecycle.h"
#include "tools/today.h"

namespace nightcity::bake {

namespace {

// Returns the areas of each map that may say uses. Where the map's buildings are to stand, their
// reader needs them next.
map_buildings::CityMaps::Areas read_building_areas(const CityInputs& inputs) {
  if (inputs.read.maps && (inputs.cover.gaps || inputs.is_map_alone()))
    return inputs.read.maps->read(inputs.max_way_nodes);
  const auto says_use = [](const osm::OsmTags& tags) {
    return lights::use_from_tags(tags).has_value();
  };
  map_buildings::CityMaps::Areas areas;
  for (const auto& file : inputs.maps)
    areas.push_back(std::make_shared<const osm::MapAreas>(osm::read_map_areas(
        file, {{"building"}, says_use}, static_cast<std::size_t>(inputs.max_way_nodes))));
  return areas;
}

}  // namespace

std::vector<osm::MapArea> read_building_multipolygons(const CityInputs& inputs,
                                                      const osm::OsmData& map) {
  std::vector<osm::MapArea> found;
  if (map.building_relations == 0) return found;
  const osm::Day day = today();
  std::set<std::string> known;  // a relation that is in several maps counts once
  for (const auto& areas : read_building_areas(inputs))
    for (const osm::MapArea& area : areas->areas)
      if (area.id.starts_with("relation/") && lights::use_from_tags(area.tags) &&
          !osm::is_gone(area.tags, day) && known.insert(area.id).second)
        found.push_back(area);
  return found;
}

lights::UseAt make_use_finder(const City& city) {
  const CityInputs& inputs = city.inputs();
  if (!city.frame().has_lon_lat()) return {};
  const std::vector<osm::MapArea> multipolygons =
      inputs.survey ? inputs.survey->map_multipolygons
                    : read_building_multipolygons(inputs, city.map());
  if (city.map().buildings.empty() && multipolygons.empty()) return {};
  const auto uses =
      std::make_shared<const lights::OsmUses>(city.map().buildings, multipolygons, city.to_frame());
  return [uses](const glm::dvec2& place) { return uses->at(place); };
}

}  // namespace nightcity::bake
