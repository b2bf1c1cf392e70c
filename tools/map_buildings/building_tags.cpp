#include "tools/map_buildings/building_tags.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <unordered_map>

#include "tools/map_buildings/levels_text.h"
#include "tools/map_buildings/roof_words.h"
#include "tools/osm/bearings.h"
#include "tools/osm/lifecycle.h"
#include "tools/osm/tag_values.h"

namespace nightcity::map_buildings {
namespace {

constexpr double max_height_m = 1000;  // the tallest building has 830
constexpr double max_levels = 200;
constexpr double least_height_m = 0.2;  // of what stands between foot and top

// Returns the greatest length in a list such as "10;12": a building is as high as its highest part.
std::optional<double> parse_greatest_m(std::string_view text) {
  std::optional<double> greatest;
  for (const std::string_view part : osm::split_list(text)) {
    const auto length = osm::parse_length_m(part);
    if (!length) return {};
    greatest = std::max(greatest.value_or(*length), *length);
  }
  return greatest;
}

// Returns a length from the first of several keys that is understood, and counts the others.
std::optional<double> find_length(const osm::OsmTags& tags, std::initializer_list<const char*> keys,
                                  city::SkipCounter& notes, double least_m = 0) {
  for (const char* key : keys) {
    const auto found = tags.find(key);
    if (found == tags.end()) continue;
    const auto length = parse_greatest_m(found->second);
    if (length && *length >= least_m && *length <= max_height_m) return length;
    notes.add(std::string(key) + "=" + found->second + ", not understood");
  }
  return {};
}

std::optional<double> find_count(const osm::OsmTags& tags, const char* key,
                                 city::SkipCounter& notes) {
  const auto found = tags.find(key);
  if (found == tags.end()) return {};
  const auto levels = parse_levels(found->second);
  const bool is_count = levels && levels->count >= 0 && levels->count <= max_levels;
  if (!is_count)
    notes.add(std::string(key) + "=" + found->second + ", not understood");
  else if (!levels->is_whole)
    notes.add(std::string(key) + "=" + found->second + ", of which the number is used");
  return is_count ? std::optional(levels->count) : std::nullopt;
}

double assume_levels(const osm::OsmTags& tags) {
  static const std::unordered_map<std::string_view, double> table{
      {"garage", 1},     {"garages", 1},      {"carport", 1},        {"shed", 1},
      {"hut", 1},        {"kiosk", 1},        {"cabin", 1},          {"greenhouse", 1},
      {"roof", 1},       {"bungalow", 1},     {"static_caravan", 1}, {"toilets", 1},
      {"service", 1},    {"apartments", 4},   {"residential", 3},    {"office", 4},
      {"commercial", 3}, {"hotel", 5},        {"hospital", 5},       {"dormitory", 4},
      {"university", 4}, {"public", 3},       {"civic", 3},          {"school", 3},
      {"church", 4},     {"cathedral", 8},    {"warehouse", 3},      {"industrial", 3},
      {"parking", 3},    {"train_station", 3}};
  std::string kind = osm::find_tag(tags, "building:part");
  if (kind.empty() || kind == "yes") kind = osm::find_tag(tags, "building");
  const auto known = table.find(kind);
  return known == table.end() ? 2 : known->second;
}

std::optional<double> find_direction(const osm::OsmTags& tags, city::SkipCounter& notes) {
  const auto found = tags.find("roof:direction");
  if (found == tags.end()) return {};
  const auto degrees = osm::parse_bearing_degrees(found->second);
  if (!degrees) notes.add("roof:direction=" + found->second + ", not understood");
  return degrees;
}

// A spire or a tent is roof from its foot to its top, but for a wall that has an area. Half of the
// height is left to the walls where a roof would take more than all.
double limit_rise(double rise_m, double room_m) {
  constexpr double rounding_m = 0.1, least_wall_m = 0.001;
  return rise_m <= room_m + rounding_m ? std::min(rise_m, room_m - least_wall_m) : room_m / 2;
}

std::optional<double> find_slope(const osm::OsmTags& tags, city::SkipCounter& notes) {
  const auto found = tags.find("roof:angle");
  if (found == tags.end()) return {};
  std::string_view rest = found->second;
  const auto degrees = osm::take_number(rest);
  if (degrees && *degrees > 0 && *degrees < 90) return degrees;
  notes.add("roof:angle=" + found->second + ", not understood");
  return {};
}

}  // namespace

void set_rise(BuildingSizes& sizes, double rise_m) {
  if (!sizes.top_is_said)
    sizes.top_m = std::min(sizes.eaves_m + rise_m, max_height_m);
  else
    sizes.eaves_m = sizes.top_m - limit_rise(rise_m, sizes.top_m - sizes.foot_m);
}

BuildingSizes find_sizes(const osm::OsmTags& tags, city::SkipCounter& notes) {
  BuildingSizes sizes;
  auto levels = find_count(tags, "building:levels", notes);
  if (!levels) levels = find_count(tags, "building:levels:aboveground", notes);
  const auto roof_levels = find_count(tags, "roof:levels", notes);
  const auto min_level = find_count(tags, "building:min_level", notes);
  sizes.foot_m = find_length(tags, {"min_height", "building:min_height"}, notes)
                     .value_or(storey_m * min_level.value_or(0));
  // A height of 0 stands for none.
  const auto height =
      find_length(tags, {"height", "building:height", "est_height"}, notes, least_height_m);
  sizes.roof = find_roof_shape(tags, notes);
  if (const std::string orientation = osm::find_tag(tags, "roof:orientation"); !orientation.empty())
    sizes.across = orientation == "across";
  sizes.direction_degrees = find_direction(tags, notes);
  if (levels && *levels >= 1) sizes.storeys = static_cast<int>(*levels);

  double roof_m = 0;
  bool roof_is_said = false;
  if (sizes.roof != RoofShape::flat) {
    const auto said = find_length(tags, {"roof:height", "building:roof:height"}, notes);
    roof_is_said = said.has_value();
    sizes.rise_is_said = said || roof_levels;
    if (!said && !roof_levels) sizes.slope_degrees = find_slope(tags, notes);
    roof_m = said.value_or(roof_levels ? storey_m * std::max(*roof_levels, 0.5) : storey_m);
  }
  sizes.top_is_said = height.has_value();
  sizes.assumed = !height && !levels;
  // "building:levels" counts those below the roof, from the ground; "height" reaches to its top.
  sizes.top_m =
      height
          ? *height
          : (levels ? storey_m * *levels : sizes.foot_m + storey_m * assume_levels(tags)) + roof_m;
  if (!height && sizes.top_m <= sizes.foot_m) sizes.top_m = sizes.foot_m + storey_m;
  if (sizes.top_m < sizes.foot_m + least_height_m) {
    notes.add("building whose min_height is not below its height");
    sizes.foot_m = 0;
    sizes.top_m = std::max(sizes.top_m, least_height_m);
  }
  // A roof that is a canopy has no walls down to the ground.
  const bool canopy =
      osm::find_tag(tags, "building") == "roof" || osm::find_tag(tags, "building:part") == "roof";
  if (canopy && sizes.foot_m == 0)
    sizes.foot_m = std::max(0.0, sizes.top_m - roof_m - least_height_m);
  const double room_m = sizes.top_m - sizes.foot_m;
  if (roof_is_said)
    roof_m = limit_rise(roof_m, room_m);
  else
    roof_m = std::min(roof_m, room_m * (canopy ? 0.9 : 0.5) + 1e-9);
  sizes.eaves_m = sizes.top_m - roof_m;
  if (roof_m < 0.01) {
    sizes.roof = RoofShape::flat;
    sizes.eaves_m = sizes.top_m;
  }
  return sizes;
}

namespace {

// "building:levels=0" beside levels below the ground: nothing of it is seen.
bool has_levels_below_alone(const osm::OsmTags& tags) {
  city::SkipCounter unused;
  for (const char* key : {"height", "building:height", "est_height"})
    if (tags.contains(key)) return false;
  const auto above = find_count(tags, "building:levels", unused),
             below = find_count(tags, "building:levels:underground", unused),
             roof = find_count(tags, "roof:levels", unused);
  return above == 0.0 && below.value_or(0) > 0 && roof.value_or(0) == 0;
}

}  // namespace

std::optional<osm::OsmTags> inherit_height(const osm::OsmTags& part, const osm::OsmTags& building) {
  constexpr std::array keys{"height", "building:height", "est_height", "building:levels",
                            "building:levels:aboveground"};
  for (const char* key : keys)
    if (part.contains(key)) return {};
  osm::OsmTags tags = part;
  for (const char* key : keys)
    if (const auto found = building.find(key); found != building.end()) tags.insert(*found);
  city::SkipCounter unused;
  const double foot_m = find_sizes(part, unused).foot_m;
  const BuildingSizes whole = find_sizes(building, unused);
  if (whole.assumed || !(whole.top_m > foot_m + least_height_m)) return {};
  return tags;
}

bool is_part_alone(const osm::OsmTags& tags) {
  const std::string part = osm::find_tag(tags, "building:part");
  return osm::find_tag(tags, "building") == "no" && !part.empty() && part != "no";
}

bool is_absent(const osm::OsmTags& tags, osm::Day day) {
  if (osm::find_tag(tags, "location") == "underground" || has_levels_below_alone(tags)) return true;
  if (osm::is_gone(tags, day)) return true;
  for (const char* key : {"building", "building:part"}) {
    const std::string value = osm::find_tag(tags, key);
    if (value == "no" && is_part_alone(tags)) continue;
    for (const char* absent : {"no", "construction", "proposed", "planned", "demolished", "razed",
                               "removed", "destroyed", "dismantled", "collapsed", "ruins"})
      if (value == absent) return true;
  }
  return false;
}

}  // namespace nightcity::map_buildings
