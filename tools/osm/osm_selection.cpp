#include "tools/osm/osm_selection.h"

#include <algorithm>
#include <array>

#include "tools/osm/tag_values.h"

namespace nightcity::osm {
namespace {

template <std::size_t N>
bool is_one_of(const std::string& value, const std::array<std::string_view, N>& names) {
  return std::find(names.begin(), names.end(), value) != names.end();
}

/// Returns whether any part of a list of values ("street_lamp;advertising") is one of the names.
template <std::size_t N>
bool has_one_of(const OsmTags& tags, const char* key,
                const std::array<std::string_view, N>& names) {
  const auto found = tags.find(key);
  if (found == tags.end()) return false;
  for (const std::string_view part : split_list(found->second))
    if (is_one_of(normalise_tag(part), names)) return true;
  return false;
}

constexpr std::array<std::string_view, 8> street_lamps = {
    "street_lamp",  "streetlamp",    "street_light", "streetlight",
    "street_lamps", "street_lights", "lamp_post",    "lamppost"};
constexpr std::array<std::string_view, 9> light_sources = {
    "lantern", "floodlight",    "flood_light", "street_lamp", "street_light",
    "lamp",    "electric_lamp", "gas_lamp",    "bollard"};
constexpr std::array<std::string_view, 4> masts = {"floodlight", "flood_light", "light_mast",
                                                   "lighting_mast"};
constexpr std::array<std::string_view, 3> controls = {"stop", "give_way", "traffic_signals"};
constexpr std::array<std::string_view, 6> watercourses = {"river", "stream", "canal",
                                                          "drain", "ditch",  "tidal_channel"};
constexpr std::array<std::string_view, 6> sports_grounds = {
    "pitch", "track", "stadium", "sports_centre", "ice_rink", "skatepark"};
constexpr std::array<std::string_view, 4> tall_things = {"tower", "mast", "chimney", "water_tower"};
constexpr std::array<std::string_view, 4> obstruction_lights = {"obstruction_light", "obstruction",
                                                                "aviation", "warning"};
constexpr std::array<std::string_view, 5> open_towers = {"lattice", "guyed_lattice", "guyed_tube",
                                                         "freestanding_lattice", "scaffolding"};
constexpr std::array<std::string_view, 9> churches = {"church", "cathedral", "chapel",
                                                      "mosque", "synagogue", "temple",
                                                      "castle", "monastery", "shrine"};

}  // namespace

bool is_lamp(const OsmTags& tags) {
  for (const char* key : {"highway", "man_made", "amenity"})
    if (has_one_of(tags, key, street_lamps)) return true;
  return has_one_of(tags, "light_source", light_sources) || has_one_of(tags, "man_made", masts) ||
         has_one_of(tags, "tower:type", std::array<std::string_view, 1>{"lighting"});
}

bool is_highway(const OsmTags& tags) {
  return is_tagged(tags, "highway") && !has_one_of(tags, "highway", street_lamps);
}

bool is_tree(const OsmTags& tags) {
  return find_tag(tags, "natural") == "tree";
}

bool is_tree_row(const OsmTags& tags) {
  return find_tag(tags, "natural") == "tree_row";
}

bool is_gate(const OsmTags& tags) {
  return is_tagged(tags, "barrier");
}

bool is_barrier(const OsmTags& tags) {
  return is_gate(tags) && !is_highway(tags) && !is_building(tags);
}

bool is_sports_ground(const OsmTags& tags) {
  return has_one_of(tags, "leisure", sports_grounds);
}

bool is_obstruction_light(const OsmTags& tags) {
  return has_one_of(tags, "aeroway", obstruction_lights) ||
         has_one_of(tags, "light_source", obstruction_lights);
}

bool may_shine(const OsmTags& tags) {
  const auto has = [&](const char* key) { return is_tagged(tags, key); };
  if (is_highway(tags)) return false;
  if (has("advertising") || has("floodlit") || find_tag(tags, "amenity") == "fuel" ||
      is_obstruction_light(tags))
    return true;
  return has("lit") &&
         (has("historic") || is_sports_ground(tags) ||
          (has_one_of(tags, "man_made", tall_things) && !is_lamp(tags)) ||
          has_one_of(tags, "building", churches) || find_tag(tags, "tourism") == "artwork" ||
          find_tag(tags, "amenity") == "place_of_worship");
}

bool is_control(const OsmTags& tags) {
  return has_one_of(tags, "highway", controls);
}

bool is_open_tower(const OsmTags& tags) {
  return find_tag(tags, "man_made") == "mast" ||
         has_one_of(tags, "tower:construction", open_towers);
}

bool is_railway(const OsmTags& tags) {
  return is_tagged(tags, "railway");
}

bool is_square(const OsmTags& tags) {
  return find_tag(tags, "place") == "square";
}

bool is_crossing(const OsmTags& tags) {
  return has_one_of(tags, "highway", std::array<std::string_view, 1>{"crossing"});
}

bool is_building(const OsmTags& tags) {
  return is_tagged(tags, "building");
}

bool is_watercourse(const OsmTags& tags) {
  return is_one_of(find_tag(tags, "waterway"), watercourses) ||
         find_tag(tags, "natural") == "coastline";
}

bool says_area(const OsmTags& tags) {
  const std::string value = find_tag(tags, "area");
  return value == "yes" || value == "true" || value == "1";
}

}  // namespace nightcity::osm
