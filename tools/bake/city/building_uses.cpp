#include "tools/bake/city/building_uses.h"

#include <cstddef>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "tools/bake/city/city_survey.h"
#include "tools/lights/osm_uses.h"
#include "tools/today.h"

namespace nightcity::bake {

std::vector<osm::MapArea> read_building_multipolygons(const CityInputs& inputs,
                                                      const osm::OsmData& map) {
  std::vector<osm::MapArea> found;
  if (map.building_relations == 0) return found;
  const auto says_use = [](const osm::OsmTags& tags) {
    return lights::use_from_tags(tags).has_value();
  };
  const osm::AreaSelection selection{{"building"}, says_use, today()};
  std::set<std::string> known;  // a relation that is in several maps counts once
  for (const auto& file : inputs.maps)
    for (osm::MapArea& area :
         osm::read_map_areas(file, selection, static_cast<std::size_t>(inputs.max_way_nodes)).areas)
      if (area.id.starts_with("relation/") && known.insert(area.id).second)
        found.push_back(std::move(area));
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
