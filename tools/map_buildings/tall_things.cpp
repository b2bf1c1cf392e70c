#include "tools/map_buildings/tall_things.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <numbers>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/in_ring.h"
#include "tools/map_buildings/building_tags.h"
#include "tools/map_buildings/drawn_twice.h"
#include "tools/map_buildings/local_plane.h"
#include "tools/map_buildings/part_index.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/tag_values.h"
#include "tools/ring_area.h"
#include "tools/today.h"

namespace nightcity::map_buildings {
namespace {

using osm::MapArea;

// Vessels of no stated height are two storeys high, as buildings of unknown kinds are.
constexpr std::array<std::string_view, 9> vessels{"silo",        "storage_tank", "tank",
                                                  "oil_tank",    "water_tank",   "bunker_silo",
                                                  "slurry_tank", "digester",     "gasometer"};
// No usual height stands for that of a tower.
constexpr std::array<std::string_view, 14> towers{
    "chimney",  "water_tower",          "cooling_tower", "tower",    "mast",
    "windmill", "communications_tower", "lighthouse",    "kiln",     "watchtower",
    "obelisk",  "bell_tower",           "minaret",       "campanile"};

bool is_one_of(std::string_view kind, std::span<const std::string_view> kinds) {
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

double find_area_m2(const MapArea& area) {
  const LocalPlane plane(area.rings.front().outer.front());
  const auto measure = [&](const std::vector<glm::dvec2>& ring) {
    std::vector<glm::dvec2> metres;
    for (const glm::dvec2& p : ring) metres.push_back(plane.to_metres(p));
    return std::abs(signed_area(metres));
  };
  double sum = 0;
  for (const osm::MapRings& rings : area.rings) {
    sum += measure(rings.outer);
    for (const std::vector<glm::dvec2>& hole : rings.holes) sum -= measure(hole);
  }
  return sum;
}

// Returns the width of something round. OpenStreetMap's diameters without a unit are millimetres,
// which the key has from pipelines, but for numbers that are far too small for that.
std::optional<double> find_diameter_m(const osm::OsmTags& tags) {
  constexpr double least_mm = 200, least_m = 0.1, greatest_m = 200;
  const std::string text = osm::find_raw_tag(tags, "diameter");
  if (auto diameter = osm::parse_length_m(text)) {
    const bool has_unit = std::any_of(text.begin(), text.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '\'' || c == '"';
    });
    if (!has_unit && *diameter >= least_mm) *diameter /= 1000;
    if (*diameter >= least_m && *diameter <= greatest_m) return diameter;
  }
  return osm::find_length_m(tags, {"width", "est_width"}, least_m, greatest_m);
}

// A thing of the map at a place inside of it.
struct Spot {
  std::size_t thing;
  glm::dvec2 place;
  double area_m2;
};

class TwiceFinder {
 public:
  explicit TwiceFinder(const std::vector<MapArea>& things)
      : things_(things), has_other_(things.size(), false) {
    for (std::size_t n = 0; n < things.size(); ++n)
      spots_.push_back({n, find_place_inside(things[n]), find_area_m2(things[n])});
    std::sort(spots_.begin(), spots_.end(),
              [](const Spot& a, const Spot& b) { return a.place.x < b.place.x; });
  }

  // Marks the things inside `area` that it stands for: they are of the same kind, or of a size. A
  // chimney in the middle of a factory is none of them. `least_share`: of the thing's area that the
  // other's has at least.
  void mark(const MapArea& area, double least_share) {
    constexpr double greatest_share = 2;
    const std::vector<glm::dvec2>& first = area.rings.front().outer;
    glm::dvec2 low = first.front(), high = low;
    for (const osm::MapRings& rings : area.rings)
      for (const glm::dvec2& p : rings.outer) low = glm::min(low, p), high = glm::max(high, p);
    auto spot = std::lower_bound(spots_.begin(), spots_.end(), low.x,
                                 [](const Spot& a, double x) { return a.place.x < x; });
    double area_m2 = 0;
    for (; spot != spots_.end() && spot->place.x <= high.x; ++spot) {
      if (spot->place.y < low.y || spot->place.y > high.y || !holds(area, spot->place)) continue;
      if (area_m2 == 0) area_m2 = find_area_m2(area);
      const double share = area_m2 / std::max(spot->area_m2, 1e-9);
      if (is_same_kind(area, things_[spot->thing]) ||
          (share >= least_share && share <= greatest_share))
        has_other_[spot->thing] = true;
    }
  }
  bool has_other(std::size_t thing) const { return has_other_[thing]; }

 private:
  static bool holds(const MapArea& area, const glm::dvec2& place) {
    const auto has = [&](const std::vector<glm::dvec2>& ring) { return in_ring(ring, place); };
    return std::any_of(area.rings.begin(), area.rings.end(), [&](const osm::MapRings& rings) {
      return has(rings.outer) && std::none_of(rings.holes.begin(), rings.holes.end(), has);
    });
  }
  static bool is_same_kind(const MapArea& area, const MapArea& thing) {
    const std::string kind = osm::find_tag(thing.tags, "man_made");
    for (const char* key : {"building", "building:part", "man_made"})
      if (osm::find_tag(area.tags, key) == kind) return true;
    return false;
  }

  const std::vector<MapArea>& things_;
  std::vector<bool> has_other_;
  std::vector<Spot> spots_;  // from west to east
};

// Returns why a thing is left out, whatever lies round it; "" for one that stands.
std::string find_reason(const MapArea& thing) {
  const std::string name = "man_made=" + find_tall_kind(thing.tags);
  if (osm::is_open_tower(thing.tags)) return name + " of bars or ropes, not drawn";
  city::SkipCounter unused;
  if (is_one_of(find_tall_kind(thing.tags), towers) && find_sizes(thing.tags, unused).assumed)
    return name + " without a height, not drawn";
  return {};
}

bool is_round(const MapArea& thing) {
  return thing.id.starts_with("node/");
}

}  // namespace

bool says_building(const osm::OsmTags& tags) {
  return tags.contains("building") || tags.contains("building:part");
}

std::string find_tall_kind(const osm::OsmTags& tags) {
  const std::string kind = osm::find_tag(tags, "man_made");
  if (kind.empty() || says_building(tags) || osm::is_lamp(tags)) return {};
  return is_one_of(kind, vessels) || is_one_of(kind, towers) ? kind : std::string();
}

std::string name_tall_function(const osm::OsmTags& tags) {
  const std::string kind = find_tall_kind(tags);
  return kind.empty() ? kind : "man_made=" + kind;
}

std::optional<MapArea> make_round_outline(const osm::MapPoint& point) {
  constexpr int corners = 32;
  if (find_tall_kind(point.tags).empty()) return {};
  city::SkipCounter unused;
  const auto diameter_m = find_diameter_m(point.tags);
  if (!diameter_m || find_sizes(point.tags, unused).assumed) return {};
  // The polygon has the area of the circle.
  const double step = 2 * std::numbers::pi / corners,
               radius_m = *diameter_m / 2 * std::sqrt(step / std::sin(step));
  const LocalPlane plane(point.lon_lat);
  MapArea area{point.id, point.tags, {{}}};
  for (int i = 0; i < corners; ++i)
    area.rings[0].outer.emplace_back(
        plane.to_degrees({radius_m * std::cos(step * i), radius_m * std::sin(step * i), 0}));
  return area;
}

void leave_out_tall_things(FileBuildings& of) {
  if (of.tall_things.empty()) return;
  const osm::Day day = today();
  std::vector<MapArea> standing;
  for (MapArea& thing : of.tall_things)
    if (const std::string reason = find_reason(thing); !reason.empty())
      ++of.left_out[reason];
    else
      standing.push_back(std::move(thing));
  TwiceFinder finder(standing);
  // A part may be the shaft of a tower alone, and a kiosk in the middle of a tank is not the tank.
  constexpr double least_building = 0.25;
  for (const MapArea& building : of.buildings)
    if (!is_absent(building.tags, day)) finder.mark(building, least_building);
  for (const MapArea& part : of.parts)
    if (!is_absent(part.tags, day)) finder.mark(part, 0);
  TwiceFinder nodes(standing);
  for (const MapArea& thing : standing)
    if (!is_round(thing) && !is_absent(thing.tags, day)) nodes.mark(thing, least_building);
  const std::vector<std::size_t> best = find_standing(standing, day);
  of.tall_things.clear();
  for (std::size_t n = 0; n < standing.size(); ++n)
    if (finder.has_other(n) || best[n] != n || (is_round(standing[n]) && nodes.has_other(n)))
      ++of.left_out["chimney, tower or tank that the map has as a building, or twice"];
    else
      of.tall_things.push_back(std::move(standing[n]));
}

}  // namespace nightcity::map_buildings
