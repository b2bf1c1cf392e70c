// Sizes and roof of a building of the map, from its tags (OpenStreetMap's "Simple 3D Buildings").
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tools/city/skip_counter.h"
#include "tools/osm/days.h"
#include "tools/osm/osm_data.h"

namespace nightcity::map_buildings {

enum class RoofShape : std::uint8_t {
  flat,
  gabled,
  gambrel,
  round,
  saltbox,
  hipped,
  half_hipped,
  mansard,
  pyramidal,
  dome,
  onion,
  skillion,
  butterfly,
  sawtooth,
  gabled_row,
  double_saltbox,
  quadruple_saltbox,
  side_hipped,
  side_half_hipped,
  gablet,
  crosspitched
};

struct BuildingSizes {
  double foot_m = 0;     // above the ground: min_height, building:min_level
  double eaves_m = 0;    // where the roof begins
  double top_m = 0;      // of the roof
  bool assumed = false;  // no tag says how high it is
  RoofShape roof = RoofShape::flat;
  // The ridge runs along the shorter side; none: as the roof falls, else along the longer side.
  std::optional<bool> across;
  std::optional<double> direction_degrees;  // the roof falls that way: clockwise from north
  std::optional<double> slope_degrees;      // roof:angle, where no tag says the roof's height
  bool top_is_said = false;                 // by a height, and not by levels
  bool rise_is_said = false;                // roof:height or roof:levels
  std::optional<int> storeys;               // building:levels
};

constexpr double storey_m = 3;

/// Returns sizes that are consistent: 0 <= foot < eaves <= top. Heights that are absent come from
/// levels of 3 m, and without these from the kind of building: garages and huts have one level,
/// houses two, flats and offices four. Counts shapes of roofs that are shown flat, and sizes that
/// contradict each other.
BuildingSizes find_sizes(const osm::OsmTags& tags, city::SkipCounter& notes);

/// Makes the roof `rise_m` high: below a top that is said, else above the eaves. Where it would
/// take more than all of the height, half of that is left to the walls.
void set_rise(BuildingSizes& sizes, double rise_m);

/// Returns a part's tags with the building's words for its height; empty where the part has words of
/// its own, the building has none that are understood, or the part begins above that.
std::optional<osm::OsmTags> inherit_height(const osm::OsmTags& part, const osm::OsmTags& building);

/// Returns whether an area is a part of a building, and says that it is none itself.
bool is_part_alone(const osm::OsmTags& tags);

/// Returns whether the building is below the ground, gone or not built yet on a day.
bool is_absent(const osm::OsmTags& tags, osm::Day day);

}  // namespace nightcity::map_buildings
