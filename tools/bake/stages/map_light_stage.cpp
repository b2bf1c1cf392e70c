#include "tools/bake/stages/map_light_stage.h"

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "tools/osm/map_areas.h"
#include "tools/osm/osm_selection.h"
#include "tools/random.h"
#include "tools/today.h"

namespace nightcity::bake {
namespace {

map_lights::SolidAt find_solids(const City& city) {
  if (!city.has_model()) return {};
  return [&city](const glm::dvec2& place) -> std::optional<map_lights::SolidSpan> {
    const terrain::Terrain& terrain = city.terrain();
    const auto low = terrain.height_of(terrain::SurfaceClass::ground_surface, place);
    const auto high = terrain.height_of(terrain::SurfaceClass::roof, place);
    if (!low || !high || *high <= *low) return std::nullopt;
    return map_lights::SolidSpan{*low, *high};
  };
}

// Multipolygons as closed ways, one for each outer ring. Counts in `left_out` what has no outline.
std::vector<osm::OsmShiningThing> read_relations(const City& city,
                                                 std::map<std::string, std::size_t>& left_out) {
  const osm::AreaSelection selection{
      {"advertising", "floodlit", "lit", "amenity"}, osm::may_shine, today()};
  std::vector<osm::OsmShiningThing> things;
  std::set<std::string> known;  // a relation that is in several maps counts once
  for (const auto& map : city.inputs().maps) {
    osm::MapAreas read =
        osm::read_map_areas(map, selection, static_cast<std::size_t>(city.inputs().max_way_nodes));
    constexpr std::string_view relation = "relation/";
    for (osm::MapArea& area : read.areas) {
      if (!area.id.starts_with(relation) || !known.insert(area.id).second) continue;
      for (osm::MapRings& rings : area.rings) {
        rings.outer.push_back(rings.outer.front());
        things.push_back(
            {std::stoll(area.id.substr(relation.size())), true, std::move(rings.outer), area.tags});
      }
    }
    if (read.gone > 0) left_out["gone or not built yet"] += read.gone;
    if (read.broken > 0)
      left_out["area that may be lit, with a broken or incomplete outline"] += read.broken;
  }
  return things;
}

}  // namespace

map_lights::MapLightSet place_city_map_lights(const City& city,
                                              const map_lights::MapLightOptions& options) {
  if (!options.lit || city.inputs().maps.empty()) return {};
  std::map<std::string, std::size_t> left_out;
  const std::vector<osm::OsmShiningThing> relations = read_relations(city, left_out);
  if (city.map().shining_things.empty() && relations.empty()) return {};
  city.require_lon_lat("lights of the map cannot be placed");
  const map_lights::Ground ground{city.to_frame(), city.height_at(), city.inside_footprint(),
                                  find_solids(city)};
  map_lights::MapLightSet set =
      map_lights::place_map_lights(city.map(), ground, options, relations);
  for (const auto& [reason, count] : left_out) set.report.left_out[reason] += count;
  return set;
}

void add_luminaires(map_lights::MapLightSet& from, lights::LampSet& lamps) {
  const auto first_profile = static_cast<std::uint32_t>(lamps.profiles.size());
  const auto first_value = static_cast<std::uint32_t>(lamps.profile_data.size());
  for (LightProfile profile : from.profiles) {
    profile.data_offset += first_value;
    lamps.profiles.push_back(profile);
  }
  lamps.profile_data.insert(lamps.profile_data.end(), from.profile_data.begin(),
                            from.profile_data.end());
  std::unordered_set<std::uint32_t> ids;
  for (const lights::PlacedLamp& lamp : lamps.lamps) ids.insert(lamp.id);
  const auto make_unused = [&ids](std::uint32_t id) {
    while (id == 0xFFFFFFFFu || !ids.insert(id).second)
      id = static_cast<std::uint32_t>(mix(id) >> 32);
    return id;
  };
  for (lights::PlacedLamp& lamp : from.luminaires) {
    lamp.id = make_unused(lamp.id);
    lamp.profile += first_profile;
    lamps.lamps.push_back(std::move(lamp));
  }
  for (lights::LitRectangle& sign : from.signs) sign.id = make_unused(sign.id);
  from.luminaires.clear();
}

}  // namespace nightcity::bake
