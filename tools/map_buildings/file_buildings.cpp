#include "tools/map_buildings/file_buildings.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <unordered_set>
#include <utility>

#include "tools/map_buildings/building_tags.h"
#include "tools/map_buildings/tall_things.h"

namespace nightcity::map_buildings {
namespace {

using osm::MapArea;
using osm::MapAreas;

MapAreas read_areas(const std::filesystem::path& file, int max_way_nodes) {
  const auto wants = [](const osm::OsmTags& tags) {
    return says_building(tags) || !find_tall_kind(tags).empty();
  };
  osm::AreaSelection selection{{"building", "building:part", "man_made"}, wants};
  selection.keeps_points = true;
  return osm::read_map_areas(file, selection, static_cast<std::size_t>(max_way_nodes));
}

// "building=no" beside "building:part" says that it is the part alone.
bool is_building(const MapArea& area) {
  return area.tags.contains("building") && !is_part_alone(area.tags);
}

void add_own(MapAreas&& areas, FileBuildings& to) {
  for (MapArea& area : areas.areas)
    if (!says_building(area.tags))
      to.tall_things.push_back(std::move(area));
    else
      (is_building(area) ? to.buildings : to.parts).push_back(std::move(area));
  for (osm::MapPoint& point : areas.kept_points)
    if (auto round = make_round_outline(point))
      to.tall_things.push_back(std::move(*round));
    else
      ++to.left_out["building, tower or tank mapped as a point, without an outline or its sizes"];
  areas.areas.clear();
  areas.kept_points.clear();
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
  for (std::vector<MapArea>* areas : {&to.buildings, &to.tall_things})
    std::erase_if(*areas, [&](const MapArea& area) { return replaced.contains(area.id); });
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
    std::vector<std::shared_ptr<MapAreas>> areas;
    for (const std::filesystem::path& file : files_)
      areas.push_back(std::make_shared<MapAreas>(read_areas(file, max_way_nodes)));
    areas_ = std::move(areas);
    max_way_nodes_ = max_way_nodes;
  }
  return {areas_.begin(), areas_.end()};
}

MapAreas CityMaps::take_only(int max_way_nodes) {
  const std::lock_guard lock(mutex_);
  const bool is_kept = max_way_nodes_ == max_way_nodes;
  max_way_nodes_.reset();
  const auto kept = std::move(areas_);
  if (!is_kept) return read_areas(files_.front(), max_way_nodes);
  // Others may still look at them.
  return kept.front().use_count() > 1 ? *kept.front() : std::move(*kept.front());
}

FileBuildings read_file_buildings(const std::filesystem::path& file,
                                  const city::ReadOptions& options) {
  FileBuildings result;
  const std::vector<std::filesystem::path> alone{file};
  const auto& maps = options.maps ? options.maps->files() : alone;
  const auto at = std::find(maps.begin(), maps.end(), file);
  if (maps.size() < 2 || at == maps.end()) {
    const bool is_of_city = options.maps && at != maps.end();
    add_own(is_of_city ? options.maps->take_only(options.max_way_nodes)
                       : read_areas(file, options.max_way_nodes),
            result);
    leave_out_tall_things(result);
    return result;
  }
  CityMaps::Areas others = options.maps->read(options.max_way_nodes);
  const auto own = others.begin() + (at - maps.begin());
  add_own(MapAreas(**own), result);
  others.erase(own);
  add_others(others, result);
  leave_out_tall_things(result);
  return result;
}

}  // namespace nightcity::map_buildings
