#include "tools/ground_cover/land_areas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "tools/ground_cover/street_areas.h"
#include "tools/ground_cover/way_line.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/tag_values.h"
#include "tools/ring_area.h"
#include "tools/roads/road_class.h"

namespace nightcity::ground_cover {
namespace {

struct Row {
  std::string_view key, value;
  int rank;
  GroundKind kind;
  bool follows_surface;  // the tag `surface` overrides the kind
};

// OSM wiki, "Map features". What lies within something else has the greater rank: a pond in a park,
// a pitch on a school's ground. Built-up land (landuse=residential, ...) says nothing about the
// ground, which stays bare.
constexpr std::array rows{
    Row{"railway", "platform", platform_rank, GroundKind::paving_stones, true},
    Row{"public_transport", "platform", platform_rank, GroundKind::paving_stones, true},
    Row{"place", "square", 700, GroundKind::paving_stones, true},
    Row{"man_made", "bridge", 660, GroundKind::concrete, true},
    Row{"man_made", "pier", 650, GroundKind::wood, true},
    Row{"man_made", "breakwater", 650, GroundKind::gravel, true},
    Row{"man_made", "groyne", 650, GroundKind::gravel, true},
    Row{"natural", "water", 600, GroundKind::water, false},
    Row{"waterway", "riverbank", 600, GroundKind::water, false},
    Row{"waterway", "dock", 600, GroundKind::water, false},
    Row{"waterway", "canal", 600, GroundKind::water, false},
    Row{"landuse", "reservoir", 600, GroundKind::water, false},
    Row{"landuse", "basin", 600, GroundKind::water, false},
    Row{"leisure", "swimming_pool", 600, GroundKind::water, false},
    Row{"amenity", "fountain", 600, GroundKind::water, false},
    Row{"leisure", "marina", 140, GroundKind::water, false},
    Row{"aeroway", "runway", 560, GroundKind::asphalt, true},
    Row{"aeroway", "taxiway", 550, GroundKind::asphalt, true},
    Row{"aeroway", "apron", 540, GroundKind::concrete, true},
    Row{"amenity", "parking_space", 535, GroundKind::asphalt, true},
    Row{"amenity", "parking", 530, GroundKind::asphalt, true},
    Row{"amenity", "motorcycle_parking", 530, GroundKind::asphalt, true},
    Row{"amenity", "bicycle_parking", 530, GroundKind::paving_stones, true},
    Row{"amenity", "fuel", 520, GroundKind::asphalt, true},
    Row{"amenity", "bus_station", 520, GroundKind::asphalt, true},
    Row{"amenity", "marketplace", 520, GroundKind::paving_stones, true},
    Row{"leisure", "track", 510, GroundKind::tartan, true},
    Row{"leisure", "pitch", 515, GroundKind::grass, true},
    Row{"leisure", "playground", 500, GroundKind::sand, true},
    Row{"golf", "bunker", 500, GroundKind::sand, false},
    Row{"golf", "water_hazard", 600, GroundKind::water, false},
    Row{"golf", "lateral_water_hazard", 600, GroundKind::water, false},
    Row{"landcover", "water", 600, GroundKind::water, false},
    Row{"landuse", "salt_pond", 600, GroundKind::water, false},
    Row{"aeroway", "helipad", 545, GroundKind::concrete, true},
    Row{"leisure", "schoolyard", 490, GroundKind::asphalt, true},
    Row{"golf", "green", 480, GroundKind::grass, true},
    Row{"golf", "tee", 480, GroundKind::grass, true},
    Row{"golf", "fairway", 470, GroundKind::grass, true},
    // Land cover grows or lies there, whatever the land is used for.
    Row{"landcover", "grass", 460, GroundKind::grass, false},
    Row{"landcover", "trees", 460, GroundKind::woodland, false},
    Row{"landcover", "scrub", 460, GroundKind::scrub, false},
    Row{"landcover", "sand", 460, GroundKind::sand, false},
    Row{"landcover", "gravel", 460, GroundKind::gravel, false},
    Row{"landcover", "ice", 460, GroundKind::ice, false},
    Row{"landcover", "snow", 460, GroundKind::snow, false},
    Row{"natural", "beach", 450, GroundKind::sand, true},
    Row{"natural", "sand", 450, GroundKind::sand, false},
    Row{"natural", "dune", 450, GroundKind::sand, false},
    Row{"natural", "desert", 450, GroundKind::sand, true},
    Row{"natural", "shingle", 450, GroundKind::gravel, false},
    Row{"natural", "scree", 450, GroundKind::gravel, false},
    Row{"natural", "bare_rock", 450, GroundKind::gravel, false},
    Row{"natural", "rock", 450, GroundKind::gravel, false},
    Row{"natural", "mud", 450, GroundKind::soil, false},
    Row{"natural", "glacier", 450, GroundKind::ice, true},
    // OSM wiki, "Tag:natural=wetland": what kind of wetland it is says what is seen.
    Row{"wetland", "tidalflat", 431, GroundKind::soil, false},
    Row{"wetland", "mud", 431, GroundKind::soil, false},
    Row{"wetland", "saltmarsh", 431, GroundKind::grass, false},
    Row{"wetland", "wet_meadow", 431, GroundKind::grass, false},
    Row{"wetland", "swamp", 431, GroundKind::woodland, false},
    Row{"wetland", "mangrove", 431, GroundKind::woodland, false},
    Row{"landuse", "flowerbed", 440, GroundKind::soil, false},
    Row{"natural", "shrubbery", 435, GroundKind::scrub, false},
    Row{"natural", "scrub", 430, GroundKind::scrub, false},
    Row{"natural", "heath", 430, GroundKind::scrub, false},
    Row{"natural", "wetland", 430, GroundKind::scrub, false},
    Row{"natural", "wood", 420, GroundKind::woodland, false},
    Row{"landuse", "forest", 420, GroundKind::woodland, false},
    Row{"landuse", "grass", 410, GroundKind::grass, true},
    Row{"landuse", "greenery", 410, GroundKind::grass, true},
    Row{"landuse", "meadow", 410, GroundKind::grass, false},
    Row{"landuse", "village_green", 410, GroundKind::grass, false},
    Row{"natural", "grassland", 410, GroundKind::grass, false},
    Row{"natural", "fell", 410, GroundKind::grass, false},
    Row{"natural", "tundra", 410, GroundKind::grass, false},
    Row{"landuse", "greenhouse_horticulture", 400, GroundKind::soil, false},
    Row{"landuse", "plant_nursery", 400, GroundKind::farmland, false},
    Row{"leisure", "garden", 360, GroundKind::grass, true},
    Row{"leisure", "dog_park", 360, GroundKind::grass, true},
    Row{"landuse", "allotments", 350, GroundKind::grass, false},
    Row{"landuse", "recreation_ground", 310, GroundKind::grass, true},
    Row{"landuse", "cemetery", 300, GroundKind::grass, false},
    Row{"amenity", "grave_yard", 300, GroundKind::grass, false},
    Row{"leisure", "park", 300, GroundKind::grass, true},
    Row{"leisure", "common", 300, GroundKind::grass, true},
    Row{"leisure", "golf_course", 300, GroundKind::grass, false},
    Row{"landuse", "orchard", 260, GroundKind::grass, false},
    Row{"landuse", "vineyard", 260, GroundKind::farmland, false},
    Row{"landuse", "farmland", 250, GroundKind::farmland, false},
    Row{"landuse", "paddy", 250, GroundKind::farmland, false},
    Row{"landuse", "farmyard", 240, GroundKind::soil, true},
    Row{"landuse", "railway", 230, GroundKind::gravel, false},
    Row{"landuse", "construction", 220, GroundKind::soil, true},
    Row{"landuse", "logging", 220, GroundKind::soil, true},
    Row{"landuse", "brownfield", 220, GroundKind::soil, true},
    Row{"landuse", "greenfield", 220, GroundKind::grass, false},
    Row{"landuse", "quarry", 220, GroundKind::gravel, true},
    Row{"landuse", "landfill", 220, GroundKind::soil, true},
    Row{"landuse", "garages", 210, GroundKind::asphalt, true},
};

std::optional<GroundKind> surface_of(const osm::OsmTags& tags) {
  const auto found = tags.find("surface");
  return found == tags.end() ? std::nullopt : find_surface(found->second);
}

// Returns whether all levels that a tag names are another than the ground's.
bool names_other_levels(const osm::OsmTags& tags) {
  const auto found = tags.find("level");
  if (found == tags.end()) return false;
  const auto levels = osm::split_list(found->second);
  return !levels.empty() && std::all_of(levels.begin(), levels.end(), [](std::string_view text) {
    const auto level = osm::take_number(text);
    return level && text.empty() && *level != 0;
  });
}

// Below the ground, in a building or on its roof.
bool lies_elsewhere(const osm::OsmTags& tags) {
  const std::string place = osm::find_tag(tags, "location"),
                    parking = osm::find_tag(tags, "parking");
  return osm::is_tagged(tags, "tunnel") || place == "underground" || place == "roof" ||
         place == "indoor" || place == "rooftop" || osm::find_tag(tags, "indoor") == "yes" ||
         parking == "underground" || parking == "multi_storey" || parking == "rooftop" ||
         (osm::find_tag(tags, "amenity") == "parking" &&
          osm::find_tag(tags, "layer").starts_with("_")) ||
         (osm::find_tag(tags, "leisure") == "swimming_pool" &&
          osm::find_tag(tags, "covered") == "yes") ||
         names_other_levels(tags);
}

// Returns the kind of a row, or the one that other tags say in more detail.
GroundKind refine(const Row& row, const osm::OsmTags& tags) {
  const std::string basin = osm::find_tag(tags, "basin"), sport = osm::find_tag(tags, "sport");
  // OSM wiki, "Key:basin": these hold water after heavy rain alone.
  if (row.kind == GroundKind::water && (basin == "detention" || basin == "infiltration"))
    return GroundKind::grass;
  if (row.value == "pitch" && sport == "beachvolleyball") return GroundKind::sand;
  // Balls must bounce there; asphalt is an assumption.
  if (row.value == "pitch" && (sport == "basketball" || sport == "streetball" ||
                               sport == "skateboard" || sport == "netball"))
    return GroundKind::asphalt;
  return row.kind;
}

// Returns the row for what is seen of an area; null where no tag says it. Each value of a list
// ("grass;meadow") counts, and of rows of one rank the first in the table.
const Row* find_row(const osm::OsmTags& tags) {
  const bool is_no_area = osm::find_tag(tags, "area") == "no";
  const Row* best = nullptr;
  for (const auto& [key, value] : tags)
    for (const std::string_view part : osm::split_list(value)) {
      const std::string word = osm::normalise_tag(part);
      const auto row = std::find_if(rows.begin(), rows.end(), [&key = key, &word](const Row& r) {
        return r.key == key && r.value == word;
      });
      if (row == rows.end()) continue;
      if (is_no_area && word == "track") continue;  // a line that ends where it begins
      if (!best || row->rank > best->rank || (row->rank == best->rank && row < best)) best = row;
    }
  return best;
}

// On some maps these values of `natural` are areas. They say what shape land has, or what stands
// on it, and nothing about the ground.
constexpr std::array shapes{"archipelago", "arete",          "bay",      "cape",      "cliff",
                            "coastline",   "crater",         "gorge",    "hill",      "isthmus",
                            "landform",    "mountain_range", "peak",     "peninsula", "plateau",
                            "ridge",       "saddle",         "sinkhole", "strait",    "tree_group",
                            "tree_row",    "valley",         "volcano"};

// Returns the tag that names a ground of no kind that the table knows; empty where there is none.
std::string find_unknown_ground(const osm::OsmTags& tags) {
  if (lies_elsewhere(tags) || tags.contains("building") || find_row(tags)) return {};
  for (const char* key : {"natural", "landcover"})
    if (const std::string value = osm::find_tag(tags, key);
        !value.empty() && value != "no" &&
        std::find(shapes.begin(), shapes.end(), value) == shapes.end())
      return std::string(key) + "=" + value;
  return {};
}

// Outlines of streets: area:highway, and highway with area=yes.
std::optional<LandUse> find_street_outline(const osm::OsmTags& tags) {
  std::string highway = osm::find_tag(tags, "area:highway");
  // A multipolygon is an area without saying so.
  if (highway.empty() && (osm::says_area(tags) || osm::find_tag(tags, "type") == "multipolygon"))
    highway = osm::find_tag(tags, "highway");
  if (highway == "traffic_island")
    return LandUse{square_rank, {surface_of(tags).value_or(GroundKind::paving_stones)}};
  if (highway == "emergency")
    return LandUse{square_rank, {surface_of(tags).value_or(GroundKind::asphalt)}};
  // Areas of many levels (stations) and rest areas are no surfaces.
  const roads::RoadClass* road = roads::find_road_class(highway);
  if (!road || highway == "corridor") return std::nullopt;
  const bool path = road->tier == roads::RoadTier::path;
  const GroundKind usual =
      path && highway != "cycleway" ? GroundKind::paving_stones : GroundKind::asphalt;
  const int rank = !path                   ? carriageway_rank + road->rank
                   : highway == "cycleway" ? track_rank
                                           : square_rank;
  return LandUse{rank, {surface_of(tags).value_or(usual), road->kerbed, !path}};
}

}  // namespace

std::optional<LandUse> find_land_use(const osm::OsmTags& tags) {
  if (lies_elsewhere(tags)) return std::nullopt;
  if (const auto street = find_street_outline(tags)) return street;
  if (tags.contains("building") || tags.contains("building:part")) return std::nullopt;
  const Row* row = find_row(tags);
  if (!row) return std::nullopt;
  const auto said = row->follows_surface ? surface_of(tags) : std::nullopt;
  return LandUse{row->rank, {said.value_or(refine(*row, tags)), false, false}};
}

osm::AreaSelection select_land() {
  osm::AreaSelection selection{{"area:highway", "highway"}, [](const osm::OsmTags& tags) {
                                 return find_land_use(tags) || !find_unknown_ground(tags).empty();
                               }};
  for (const Row& row : rows) selection.keys.emplace_back(row.key);
  std::sort(selection.keys.begin(), selection.keys.end());
  selection.keys.erase(std::unique(selection.keys.begin(), selection.keys.end()),
                       selection.keys.end());
  return selection;
}

void add_land(std::span<const osm::MapArea> areas, const place::LonLatToFrame& to_frame,
              const Box& bounds, Cover& cover) {
  std::vector<std::pair<double, CoverArea>> found;  // with their areas, m2
  for (const osm::MapArea& area : areas) {
    const auto use = find_land_use(area.tags);
    if (!use) {
      const auto lies_here = [&](const osm::MapRings& rings) {
        return find_line(rings.outer, to_frame, bounds).size() >= 3;
      };
      const std::string unknown = find_unknown_ground(area.tags);
      if (!unknown.empty() && std::any_of(area.rings.begin(), area.rings.end(), lies_here))
        ++cover.left_out["land with " + unknown];
      continue;
    }
    if (const auto surface = area.tags.find("surface");
        surface != area.tags.end() && !find_surface(surface->second))
      ++cover.assumed["surface of land whose tag is not known"];
    for (const osm::MapRings& rings : area.rings) {
      CoverArea made{use->rank, use->surface, {find_line(rings.outer, to_frame, bounds)}};
      if (made.rings[0].size() < 3) continue;  // beyond the ground
      for (const auto& hole : rings.holes)
        if (Ring ring = find_line(hole, to_frame, bounds); ring.size() >= 3)
          made.rings.push_back(std::move(ring));
      if (made.surface.kind == GroundKind::woodland)
        made.tags = std::make_shared<const osm::OsmTags>(area.tags);
      const double m2 = std::abs(signed_area(made.rings[0]));
      found.emplace_back(m2, std::move(made));
    }
  }
  // The kinds of areas of one size decide, and not their order in the map.
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first, a.second.surface) < std::pair(b.first, b.second.surface);
  });
  for (auto& [m2, area] : found) cover.add(std::move(area));
}

}  // namespace nightcity::ground_cover
