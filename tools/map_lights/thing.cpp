#include "tools/map_lights/thing.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "formats/finite.h"
#include "tools/lights/lit_hours.h"
#include "tools/lights/lit_tag.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/tag_values.h"

namespace nightcity::map_lights {
namespace {

constexpr std::array<std::string_view, 4> flat_memorials = {"plaque", "stolperstein", "plate",
                                                            "bench"};
constexpr std::array<std::string_view, 4> flat_artworks = {"mural", "graffiti", "mosaic",
                                                           "painting"};

bool names_one_of(const osm::OsmTags& tags, const char* key,
                  std::span<const std::string_view> words) {
  return std::find(words.begin(), words.end(), osm::find_tag(tags, key)) != words.end();
}

std::optional<lights::NightSchedule> find_tagged_hours(MapLightKind kind,
                                                       const osm::OsmShiningThing& thing,
                                                       std::map<std::string, std::size_t>& notes) {
  const osm::OsmTags& tags = thing.tags;
  const lights::Half half = half_of(thing);
  for (const char* key : {"floodlit", "lit"})
    if (const auto hours = lights::read_lit_tags(tags, key, half).lit.hours) return hours;
  if (kind != MapLightKind::petrol_station) return std::nullopt;
  const std::string opening = osm::find_raw_tag(tags, "opening_hours");
  if (opening.empty()) return std::nullopt;
  const auto hours = lights::parse_lit_hours(opening, half);
  if (!hours) ++notes["opening hours that cannot be read"];
  return hours;
}

}  // namespace

bool is_flat(const osm::OsmTags& tags) {
  return names_one_of(tags, "memorial", flat_memorials) ||
         names_one_of(tags, "artwork_type", flat_artworks);
}

bool is_pitch(const osm::OsmTags& tags) {
  const std::string leisure = osm::find_tag(tags, "leisure");
  return leisure == "pitch" || leisure == "track";
}

bool is_roofed(const osm::OsmTags& tags) {
  return osm::find_tag(tags, "covered") == "yes" ||
         (osm::is_building(tags) && osm::find_tag(tags, "leisure") != "stadium");
}

lights::Half half_of(const osm::OsmShiningThing& thing) {
  return lights::half_at(thing.lon_lat.empty() ? 0 : thing.lon_lat.front().y);
}

std::optional<MapLightKind> find_kind(const osm::OsmTags& tags) {
  const auto word = [&](const char* key) { return osm::find_tag(tags, key); };
  const auto has = [&](const char* key) { return osm::is_tagged(tags, key); };
  if (has("advertising")) return MapLightKind::advertising;
  if (word("amenity") == "fuel") return MapLightKind::petrol_station;
  if (osm::is_obstruction_light(tags)) return MapLightKind::floodlit;  // which it is not, and told
  if (osm::is_sports_ground(tags)) return MapLightKind::pitch;
  if (has("floodlit") || has("lit")) return MapLightKind::floodlit;
  return std::nullopt;
}

Hours find_hours(MapLightKind kind, const osm::OsmShiningThing& thing,
                 const MapLightOptions& options, std::map<std::string, std::size_t>& notes) {
  if (const auto hours = find_tagged_hours(kind, thing, notes)) return {*hours, ValueSource::tag};
  const auto asked = options.off.find(kind);
  const lights::NightSpan dark = asked == options.off.end() ? find_dark_span(kind) : asked->second;
  return {lights::dark_between(dark.from, dark.to)};
}

std::vector<glm::dvec2> find_outline(const osm::OsmShiningThing& thing,
                                     const place::LonLatToFrame& to_frame) {
  std::vector<glm::dvec2> outline;
  for (const glm::dvec2& lon_lat : thing.lon_lat) {
    outline.push_back(to_frame(lon_lat));
    if (!finite(outline.back())) return {};
  }
  if (is_closed(thing.lon_lat)) outline.pop_back();
  return outline;
}

bool is_closed(const std::vector<glm::dvec2>& lon_lat) {
  return lon_lat.size() > 3 && lon_lat.front() == lon_lat.back();
}

}  // namespace nightcity::map_lights
