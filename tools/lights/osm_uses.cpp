#include "tools/lights/osm_uses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "tools/in_ring.h"
#include "tools/osm/tag_values.h"
#include "tools/ring_area.h"

namespace nightcity::lights {
namespace {

using enum BuildingUse;

constexpr double use_cell_m = 50, widest_m = 2000;

// Values of building=* as the OSM wiki lists them.
constexpr std::array<std::pair<std::string_view, BuildingUse>, 129> buildings = {{
    {"apartments", residential},
    {"house", residential},
    {"detached", residential},
    {"residential", residential},
    {"terrace", residential},
    {"semidetached_house", residential},
    {"dormitory", residential},
    {"bungalow", residential},
    {"farm", residential},
    {"villa", residential},
    {"allotment_house", dark},
    {"cabin", residential},
    {"mixed_use", mixed},
    {"mixed", mixed},
    {"office", office},
    {"bank", office},
    {"commercial", office},
    {"retail", retail},
    {"shop", retail},
    {"supermarket", retail},
    {"kiosk", retail},
    {"mall", retail},
    {"restaurant", retail},
    {"hotel", hotel},
    {"hostel", hotel},
    {"school", education},
    {"university", education},
    {"college", education},
    {"kindergarten", education},
    {"hospital", civic},
    {"public", civic},
    {"civic", civic},
    {"government", civic},
    {"train_station", civic},
    {"transportation", civic},
    {"museum", civic},
    {"theatre", civic},
    {"fire_station", civic},
    {"sports_hall", civic},
    {"sports_centre", civic},
    {"library", civic},
    {"townhall", civic},
    {"industrial", industrial},
    {"warehouse", industrial},
    {"factory", industrial},
    {"manufacture", industrial},
    {"garage", dark},
    {"garages", dark},
    {"carport", dark},
    {"shed", dark},
    {"hut", dark},
    {"barn", dark},
    {"greenhouse", dark},
    {"church", dark},
    {"chapel", dark},
    {"cathedral", dark},
    {"roof", dark},
    {"parking", dark},
    {"transformer_tower", dark},
    {"service", dark},
    {"silo", dark},
    {"storage_tank", dark},
    {"tank", dark},
    {"water_tower", dark},
    {"chimney", dark},
    {"tower", dark},
    {"gasometer", dark},
    {"cooling_tower", dark},
    {"digester", dark},
    {"slurry_tank", dark},
    {"bunker", dark},
    {"stable", dark},
    {"cowshed", dark},
    {"sty", dark},
    {"livestock", dark},
    {"farm_auxiliary", dark},
    {"windmill", dark},
    {"watermill", dark},
    {"mosque", dark},
    {"temple", dark},
    {"synagogue", dark},
    {"shrine", dark},
    {"religious", dark},
    {"wayside_shrine", dark},
    {"ruins", dark},
    {"tent", dark},
    {"container", dark},
    {"hangar", dark},
    {"boathouse", dark},
    {"conservatory", dark},
    {"beach_hut", dark},
    {"bridge", dark},
    {"shelter", dark},
    {"pavilion", dark},
    {"storage", dark},
    {"outbuilding", dark},
    {"substation", dark},
    {"transformer", dark},
    {"pumping_station", dark},
    {"bicycle_parking", dark},
    {"gazebo", dark},
    {"static_caravan", residential},
    {"houseboat", residential},
    {"ger", residential},
    {"stilt_house", residential},
    {"annexe", residential},
    {"tree_house", residential},
    {"castle", civic},
    {"palace", civic},
    {"monastery", dark},
    {"presbytery", residential},
    {"grandstand", civic},
    {"stadium", civic},
    {"toilets", civic},
    {"gatehouse", civic},
    {"courthouse", civic},
    {"prison", civic},
    {"military", civic},
    {"barracks", residential},
    {"clinic", civic},
    {"cinema", civic},
    {"sports", civic},
    {"pub", retail},
    {"cafe", retail},
    {"car_repair", industrial},
    {"works", industrial},
    {"brewery", industrial},
    {"data_center", industrial},
    {"power", dark},
}};

constexpr std::array<std::pair<std::string_view, BuildingUse>, 12> amenities = {{
    {"school", education},
    {"university", education},
    {"college", education},
    {"kindergarten", education},
    {"hospital", civic},
    {"clinic", civic},
    {"townhall", civic},
    {"library", civic},
    {"theatre", civic},
    {"restaurant", retail},
    {"place_of_worship", dark},
    {"parking", dark},
}};

template <std::size_t N>
std::optional<BuildingUse> look_up(
    const std::array<std::pair<std::string_view, BuildingUse>, N>& table, const std::string& word) {
  for (const auto& [name, use] : table)
    if (word == name) return use;
  return std::nullopt;
}

std::int64_t find_use_cell(double v) {
  return static_cast<std::int64_t>(std::floor(v / use_cell_m));
}

std::uint64_t key(std::int64_t x, std::int64_t y) {
  return static_cast<std::uint64_t>(x) << 32 ^ (static_cast<std::uint64_t>(y) & 0xFFFFFFFFu);
}

}  // namespace

std::optional<BuildingUse> use_from_tags(const osm::OsmTags& tags) {
  const auto value = [&](const char* key) { return osm::find_tag(tags, key); };
  if (const auto use = look_up(buildings, value("building"))) return use;
  if (!value("shop").empty()) return retail;
  if (!value("office").empty()) return office;
  const std::string tourism = value("tourism");
  if (tourism == "hotel" || tourism == "hostel" || tourism == "guest_house") return hotel;
  return look_up(amenities, value("amenity"));
}

OsmUses::OsmUses(const std::vector<osm::OsmWay>& ways,
                 const std::vector<osm::MapArea>& multipolygons,
                 const std::function<glm::dvec2(const glm::dvec2&)>& to_frame) {
  const auto place = [&](const std::vector<glm::dvec2>& lon_lat, std::size_t count) {
    std::vector<glm::dvec2> ring;
    for (std::size_t n = 0; n < count; ++n) ring.push_back(to_frame(lon_lat[n]));
    return ring;
  };
  for (const osm::OsmWay& way : ways) {
    const auto use = use_from_tags(way.tags);
    if (!use || way.lon_lat.size() < 4 || way.lon_lat.front() != way.lon_lat.back()) continue;
    add({place(way.lon_lat, way.lon_lat.size() - 1), {}, 0, *use});
  }
  for (const osm::MapArea& area : multipolygons) {
    const auto use = use_from_tags(area.tags);
    if (!use) continue;
    for (const osm::MapRings& rings : area.rings) {
      Outline outline{place(rings.outer, rings.outer.size()), {}, 0, *use};
      for (const std::vector<glm::dvec2>& hole : rings.holes)
        outline.holes.push_back(place(hole, hole.size()));
      add(std::move(outline));
    }
  }
}

void OsmUses::add(Outline outline) {
  glm::dvec2 low = outline.ring.front(), high = low;
  for (const glm::dvec2& p : outline.ring) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  outline.area_m2 = std::abs(signed_area(outline.ring));
  for (const std::vector<glm::dvec2>& hole : outline.holes)
    outline.area_m2 -= std::abs(signed_area(hole));
  // Coordinates that are not finite fail this comparison too.
  if (!(outline.area_m2 > 0 && high.x - low.x < widest_m && high.y - low.y < widest_m)) return;
  const auto number = static_cast<std::uint32_t>(outlines_.size());
  for (std::int64_t x = find_use_cell(low.x); x <= find_use_cell(high.x); ++x)
    for (std::int64_t y = find_use_cell(low.y); y <= find_use_cell(high.y); ++y)
      cells_[key(x, y)].push_back(number);
  outlines_.push_back(std::move(outline));
}

std::optional<BuildingUse> OsmUses::at(const glm::dvec2& place) const {
  const auto cell = cells_.find(key(find_use_cell(place.x), find_use_cell(place.y)));
  if (cell == cells_.end()) return std::nullopt;
  const Outline* smallest = nullptr;
  for (const std::uint32_t number : cell->second) {
    const Outline& outline = outlines_[number];
    const auto key = [](const Outline& one) { return std::pair(one.area_m2, one.use); };
    const auto holds = [&](const std::vector<glm::dvec2>& ring) { return in_ring(ring, place); };
    if ((!smallest || key(outline) < key(*smallest)) && holds(outline.ring) &&
        std::none_of(outline.holes.begin(), outline.holes.end(), holds))
      smallest = &outline;
  }
  return smallest ? std::optional(smallest->use) : std::nullopt;
}

}  // namespace nightcity::lights
