#include "tools/map_buildings/file_buildings.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "tools/map_buildings/building_tags.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/tag_values.h"

namespace nightcity::map_buildings {
namespace {

using osm::MapArea;
using osm::MapAreas;

bool says_building(const osm::OsmTags& tags) {
  return tags.contains("building") || tags.contains("building:part");
}

// Returns what a thing is that stands as high as buildings, without being one: "chimney", say.
std::string find_tall_kind(const osm::OsmTags& tags) {
  constexpr std::array<std::string_view, 12> kinds{
      "chimney", "silo", "storage_tank", "gasometer",  "water_tower",          "cooling_tower",
      "tower",   "mast", "windmill",     "lighthouse", "communications_tower", "bunker_silo"};
  const std::string kind = osm::find_tag(tags, "man_made");
  if (kind.empty() || says_building(tags) || osm::is_lamp(tags)) return {};
  return std::find(kinds.begin(), kinds.end(), kind) == kinds.end() ? std::string() : kind;
}

MapAreas read_areas(const std::filesystem::path& file, int max_way_nodes) {
  const auto wants = [](const osm::OsmTags& tags) {
    return says_building(tags) || !find_tall_kind(tags).empty();
  };
  return osm::read_map_areas(file, {{"building", "building:part", "man_made"}, wants},
                             static_cast<std::size_t>(max_way_nodes));
}

// "building=no" beside "building:part" says that it is the part alone.
bool is_building(const MapArea& area) {
  return area.tags.contains("building") && !is_part_alone(area.tags);
}

void add_own(MapAreas&& areas, FileBuildings& to) {
  for (MapArea& area : areas.areas)
    if (!says_building(area.tags))
      ++to.tall_things[find_tall_kind(area.tags)];
    else
      (is_building(area) ? to.buildings : to.parts).push_back(std::move(area));
  areas.areas.clear();
  to.counts = std::move(areas);
  to.own = to.buildings.size();
  to.is_own_part.assign(to.parts.size(), true);
}

// The order of parts must not depend on the file: a building that two tiles have is the same in
// both.
void sort_parts(FileBuildings& of) {
  std::vector<std::size_t> order(of.parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return of.parts[a].id < of.parts[b].id; });
  std::vector<MapArea> parts;
  std::vector<bool> is_own;
  for (const std::size_t n : order) {
    parts.push_back(std::move(of.parts[n]));
    is_own.push_back(of.is_own_part[n]);
  }
  of.parts = std::move(parts);
  of.is_own_part = std::move(is_own);
}

void add_others(const CityMaps::Areas& others, FileBuildings& to) {
  std::unordered_set<std::string> replaced, known;
  for (const auto& other : others) replaced.insert(other->replaced.begin(), other->replaced.end());
  std::erase_if(to.buildings, [&](const MapArea& area) { return replaced.contains(area.id); });
  to.own = to.buildings.size();
  for (const MapArea& area : to.buildings) known.insert(area.id);
  for (const MapArea& area : to.parts) known.insert(area.id);
  for (const auto& other : others)
    for (const MapArea& area : other->areas) {
      if (!says_building(area.tags) || replaced.contains(area.id) || !known.insert(area.id).second)
        continue;
      (is_building(area) ? to.buildings : to.parts).push_back(area);
    }
  to.is_own_part.resize(to.parts.size(), false);
  sort_parts(to);
}

}  // namespace

CityMaps::Areas CityMaps::read(int max_way_nodes) {
  const std::lock_guard lock(mutex_);
  if (max_way_nodes_ != max_way_nodes) {
    Areas areas;
    for (const std::filesystem::path& file : files_)
      areas.push_back(std::make_shared<const MapAreas>(read_areas(file, max_way_nodes)));
    areas_ = std::move(areas);
    max_way_nodes_ = max_way_nodes;
  }
  return areas_;
}

FileBuildings read_file_buildings(const std::filesystem::path& file,
                                  const city::ReadOptions& options) {
  FileBuildings result;
  const std::vector<std::filesystem::path> alone{file};
  const auto& maps = options.maps ? options.maps->files() : alone;
  const auto at = std::find(maps.begin(), maps.end(), file);
  if (maps.size() < 2 || at == maps.end()) {
    add_own(read_areas(file, options.max_way_nodes), result);
    return result;
  }
  CityMaps::Areas others = options.maps->read(options.max_way_nodes);
  const auto own = others.begin() + (at - maps.begin());
  add_own(MapAreas(**own), result);
  others.erase(own);
  add_others(others, result);
  return result;
}

}  // namespace nightcity::map_buildings
