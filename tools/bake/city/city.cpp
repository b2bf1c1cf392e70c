#include "tools/bake/city/city.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "formats/error.h"
#include "tools/bake/city/map_reach.h"
#include "tools/bake/city/prepared_objects.h"
#include "tools/bake/parts/read_parts.h"
#include "tools/barriers/outlines.h"
#include "tools/bridges/deck_ways.h"
#include "tools/ground_cover/junction_corners.h"
#include "tools/ground_cover/land_areas.h"
#include "tools/ground_cover/rail_areas.h"
#include "tools/ground_cover/sea.h"
#include "tools/ground_cover/street_areas.h"
#include "tools/ground_cover/watercourses.h"
#include "tools/inventory/add_to_map.h"
#include "tools/map_buildings/file_buildings.h"
#include "tools/names/find_named_streets.h"
#include "tools/osm/map_areas.h"
#include "tools/osm/read_osm.h"
#include "tools/roads/parking_lane.h"
#include "tools/streets/street_ways.h"
#include "tools/today.h"
#include "tools/traffic/country.h"

namespace nightcity::bake {

City::City(CityInputs inputs, const std::filesystem::path& scratch)
    : inputs_(std::move(inputs)), terrain_(scratch), ground_(terrain_, inputs_.ground) {
  // Each city has its own, so that what they keep goes with it.
  inputs_.read.maps = std::make_shared<map_buildings::CityMaps>(inputs_.maps);
  if (!inputs_.files.empty()) frames_.emplace(inputs_);
  if (has_model() && inputs_.ground.carries_buildings) {
    heights_.emplace(inputs_.ground, frame());
    const glm::dvec2 middle(frames_->reference());
    frames_->raise_reference(heights_->near(middle));
  }
  if (inputs_.survey)
    map_.buildings = inputs_.survey->map_buildings;
  else
    map_ = osm::read_osm(inputs_.maps, static_cast<std::size_t>(inputs_.max_way_nodes));
  // The width of a carriageway says whether cars park on it, to every stage that asks for it.
  if (!inputs_.cover.parking)
    for (osm::OsmWay& way : map_.highways) roads::drop_parking(way.tags);
  if (inputs_.cover.barriers && map_.barrier_relations > 0) add_barrier_outlines();
  note_left_out();
  if (!inputs_.survey) inventory_reports_ = inventory::add_to_map(inputs_.inventories, map_);
  if (!has_model()) map_frame_ = find_map_frame(map_);
  if (has_model()) report_moved_origin();
}

void City::note_left_out() const {
  const auto note = [&](std::size_t count, const std::string& what) {
    if (count > 0)
      fmt::print(stderr, "note: {}: {} {}\n", inputs_.maps.front().string(), count, what);
  };
  note(map_.long_ways, "ways left out: they have more nodes than [osm] max_way_nodes = " +
                           std::to_string(inputs_.max_way_nodes));
  note(map_.bad_coordinates,
       "nodes left out: their coordinates are missing, no numbers or not on the globe");
  note(map_.gone,
       "elements left out: they are gone or not built yet (end_date, demolished, start_date, ...)");
  note(map_.crowded_ways, "streets or tracks left out: no more than " +
                              std::to_string(osm::max_streets_at_node) +
                              " may go through one place");
  note(map_.repeated, "elements left out: the map has them twice in one place");
  note(map_.lamp_relations, "lamps left out: they are relations whose members the map lacks");
  note(map_.roof_lines, "ways of roofs not read (roof:ridge, roof:edge)");
}

void City::add_barrier_outlines() {
  std::set<std::string> known;
  for (const auto& map : inputs_.maps)
    for (osm::OsmWay& way :
         barriers::read_outlines(map, static_cast<std::size_t>(inputs_.max_way_nodes), known))
      map_.barriers.push_back(std::move(way));
}

CityReport City::read(std::initializer_list<CityConsumer*> consumers,
                      const ProgressSink& progress) {
  if (!has_model()) return {};
  std::vector<CityConsumer*> all{&ground_};
  for (CityConsumer* consumer : consumers)
    if (consumer) all.push_back(consumer);
  const GroundHeights* heights = ground_heights();
  return inputs_.parts.empty()
             ? read_prepared_objects(inputs_, *frames_, heights, all, progress)
             : read_parts(inputs_.parts, inputs_, *frames_, heights, all, progress);
}

GroundReport City::build_ground(std::initializer_list<CityConsumer*> consumers,
                                const GroundBuilder::ShowGround& show) {
  if (!has_model()) return {};
  if (inputs_.is_map_alone() && frame().has_lon_lat())
    ground_.reach_for(find_map_places(map_, inputs_.cover, to_frame()));
  GroundReport report = ground_.build(frame(), show);
  if (inputs_.cover.gaps && frame().has_lon_lat() && !inputs_.is_map_alone()) fill_gaps(consumers);
  lay_cover(report);
  return report;
}

void City::fill_gaps(std::initializer_list<CityConsumer*> consumers) {
  std::vector<CityConsumer*> all;
  for (CityConsumer* consumer : consumers)
    if (consumer) all.push_back(consumer);
  city::ReadOptions options = inputs_.read;
  options.max_way_nodes = inputs_.max_way_nodes;
  // A map that is among the model's files has brought its buildings; so has an earlier map of the
  // same place, which the terrain knows.
  for (const auto& map : inputs_.maps)
    if (std::find(inputs_.files.begin(), inputs_.files.end(), map) == inputs_.files.end())
      bake::fill_gaps(map, options, frame(), terrain_, all, ground_, gaps_);
}

void City::add_land(const ground_cover::Box& bounds) {
  std::set<std::string> known;  // an area that is in several maps counts once
  for (const auto& map : inputs_.maps) {
    osm::AreaSelection selection = ground_cover::select_land();
    selection.day = today();
    osm::MapAreas land =
        osm::read_map_areas(map, selection, static_cast<std::size_t>(inputs_.max_way_nodes));
    std::erase_if(land.areas, [&](const auto& area) { return !known.insert(area.id).second; });
    ground_cover::add_land(land.areas, to_frame(), bounds, cover_);
    if (land.broken > 0)
      cover_.left_out["area whose outline crosses itself or is incomplete"] += land.broken;
    if (land.gone > 0) cover_.left_out["area that is gone or not built yet"] += land.gone;
    if (land.too_long > 0)
      cover_.left_out["area of more nodes than [osm] max_way_nodes"] += land.too_long;
  }
}

std::vector<osm::MapArea> City::read_squares() const {
  std::set<std::string> known;
  std::vector<osm::MapArea> squares;
  osm::AreaSelection selection = names::select_squares();
  selection.day = today();
  for (const auto& map : inputs_.maps)
    for (osm::MapArea& area :
         osm::read_map_areas(map, selection, static_cast<std::size_t>(inputs_.max_way_nodes)).areas)
      if (known.insert(area.id).second) squares.push_back(std::move(area));
  return squares;
}

bool City::drives_on_the_left() const {
  const auto& side = inputs_.cover.side;
  const glm::dvec2 place = frame().to_lon_lat(glm::dvec2(frames_->reference()));
  return side.value_or(traffic::country_at(place).side) == traffic::Side::left;
}

void City::lay_cover(const GroundReport& ground) {
  const auto box = terrain_.extent();
  if (!ground.shown || !box || !frame().has_lon_lat()) return;
  const ground_cover::Box bounds{box->low, box->high};
  const place::LonLatToFrame to_plan = to_frame();
  const CoverOptions& options = inputs_.cover;
  const bool has_streets = options.streets && !ground.has_roads;
  if (options.bridges && has_streets && !ground.has_bridges)
    bridges_.build(map_, to_plan, height_at(),
                   {options.markings, options.rails, drives_on_the_left()});
  const auto find_ground_ways = [&](const std::vector<osm::OsmWay>& ways) {
    return bridges::find_ground_ways(ways, bridges_.decks(), to_plan);
  };
  if (has_streets) {
    const std::vector<osm::OsmWay> streets = find_ground_ways(map_.highways);
    ground_cover::add_streets(streets, options.parking, to_plan, bounds, cover_);
    if (options.rounded_corners) ground_cover::add_corners(streets, to_plan, bounds, cover_);
    if (options.lowered_kerbs)
      ground_cover::add_kerb_ramps(streets, map_.crossings, to_plan, bounds, cover_);
    if (options.markings)
      ground_cover::add_markings(
          {streets, map_.controls, map_.crossings, drives_on_the_left(), options.parking}, to_plan,
          bounds, cover_);
  }
  if (options.land && !ground.has_land) {
    add_land(bounds);
    ground_cover::add_watercourses(map_.watercourses, to_plan, bounds, cover_);
    ground_cover::add_sea(map_.watercourses, map_.bounds, to_plan, bounds, cover_);
  }
  if (options.rails && !ground.has_roads)
    ground_cover::add_rails(find_ground_ways(map_.railways), to_plan, bounds, cover_);
  cover_.finish();
}

bool City::wants_model_streets() const {
  return has_model() && map_.highways.empty() && frame().has_lon_lat();
}

StreetReport City::add_model_streets(const streets::RoadSurfaces& roads) {
  streets::StreetWays streets = streets::find_street_ways(
      roads, [this](const glm::dvec2& p) { return frame().to_lon_lat(p); },
      inputs_.read.polygon.max_crossings, inputs_.max_road_points);
  for (osm::OsmWay& way : streets.ways) map_.highways.push_back(std::move(way));
  return {roads.surfaces().size(), roads.left_out(),  streets.km,
          streets.km_by_code,      streets.junctions, streets.ends};
}

place::HeightAt City::height_at() const {
  if (!has_model()) return [](const glm::dvec2&) { return std::optional(0.0); };
  // The plane that a map alone stands on goes on beyond its ground, but not round the earth: a row
  // of an inventory at 0, 0 is no lamp of this city.
  constexpr double plane_reach_m = 100'000;
  const auto box = terrain_.extent();
  const bool has_plane = inputs_.is_map_alone() && !inputs_.ground.carries_buildings;
  return [this, has_plane, box](const glm::dvec2& place) -> std::optional<double> {
    const auto hit = terrain_.height_at(place);
    if (!hit && has_plane) {
      const bool is_near =
          !box || glm::distance(glm::clamp(place, box->low, box->high), place) <= plane_reach_m;
      return is_near ? std::optional(0.0) : std::nullopt;
    }
    if (!hit || hit->surface == terrain::SurfaceClass::roof) return std::nullopt;
    const bool covered = hit->surface == terrain::SurfaceClass::terrain;
    return hit->height_m - (covered ? cover_.depth_at(place) : 0);
  };
}

place::InsideBuilding City::inside_footprint() const {
  if (!has_model()) return {};
  return [this](const glm::dvec2& place) {
    return terrain_.height_of(terrain::SurfaceClass::ground_surface, place).has_value();
  };
}

}  // namespace nightcity::bake
