#include "tools/osm/osm_selection.h"

#include <algorithm>
#include <array>

#include "tools/osm/tag_values.h"

namespace nightcity {
namespace {

std::string value_of(const OsmTags& tags, const char* key) {
  const auto found = tags.find(key);
  return found == tags.end() ? std::string() : normalise_tag(found->second);
}

template <std::size_t N>
bool one_of(const std::string& value, const std::array<std::string_view, N>& names) {
  return std::find(names.begin(), names.end(), value) != names.end();
}

constexpr std::array<std::string_view, 8> street_lamps = {
    "street_lamp",  "streetlamp",    "street_light", "streetlight",
    "street_lamps", "street_lights", "lamp_post",    "lamppost"};
constexpr std::array<std::string_view, 8> light_sources = {
    "lantern",      "floodlight", "flood_light",   "street_lamp",
    "street_light", "lamp",       "electric_lamp", "gas_lamp"};
constexpr std::array<std::string_view, 4> masts = {"floodlight", "flood_light", "light_mast",
                                                   "lighting_mast"};

}  // namespace

bool is_lamp(const OsmTags& tags) {
  for (const char* key : {"highway", "man_made", "amenity"})
    if (one_of(value_of(tags, key), street_lamps)) return true;
  return one_of(value_of(tags, "light_source"), light_sources) ||
         one_of(value_of(tags, "man_made"), masts) || value_of(tags, "tower:type") == "lighting";
}

bool is_highway(const OsmTags& tags) {
  const std::string value = value_of(tags, "highway");
  return !value.empty() && value != "no" && !one_of(value, street_lamps);
}

bool is_building(const OsmTags& tags) {
  const std::string value = value_of(tags, "building");
  return !value.empty() && value != "no";
}

}  // namespace nightcity
