#include "tools/bridges/bridge_way.h"

#include <algorithm>
#include <cmath>

#include "formats/finite.h"
#include "tools/ground_cover/street_areas.h"
#include "tools/ground_cover/tracks.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/tag_values.h"
#include "tools/roads/carriageway.h"

namespace nightcity::bridges {
namespace {

// RiZ-ING, Kap 1: a cap beside a carriageway without a pavement, from the kerb to the edge.
constexpr double cap_m = 2.05;
// Beyond pavements, paths and beds: what carries the railing (RiZ-ING, Kap 1).
constexpr double ledge_m = 0.25;

}  // namespace

const char* name_of(Carried kind) {
  constexpr const char* names[] = {"streets", "paths", "railways"};
  return names[static_cast<std::size_t>(kind)];
}

// Gradients: RASt 06 (8 %, and 12 % in exceptions, which paths take here); EBO, section 7 (40 per
// mille on secondary lines). Crests: RASt 06 (250 m), ERA 2010 (40 m at 20 km/h), EBO (2000 m).
// Clear heights: RASt 06 (4.50 m, and 2.50 m for paths, which is also the least that anything
// passes below here); 4.90 m over railways, 5.70 m with a contact line, are assumptions: EBO,
// section 9 and annex 1, has a gauge of 4.80 m and room for the contact line above it.
CarriedKind find_kind(Carried kind, bool electric) {
  constexpr double least_m = 2.5;
  switch (kind) {
    case Carried::street:
      return {{0.08, 250}, 4.5, least_m};
    case Carried::path:
      return {{0.12, 40}, 2.5, least_m};
    case Carried::rail:
      return {{0.04, 2000}, electric ? 5.7 : 4.9, least_m};
  }
  return {};
}

std::optional<Carried> find_carried(const osm::OsmTags& tags) {
  if (osm::says_area(tags)) return std::nullopt;
  if (const auto road = roads::read_carriageway(tags)) {
    if (ground_cover::lies_inside(tags)) return std::nullopt;
    return road->road_class->tier == roads::RoadTier::path ? Carried::path : Carried::street;
  }
  const ground_cover::TrackKind* track =
      ground_cover::find_track_kind(osm::find_tag(tags, "railway"));
  if (!track || !ground_cover::find_reason_to_leave_out(tags, *track).empty()) return std::nullopt;
  return Carried::rail;
}

bool is_bridge(const osm::OsmTags& tags) {
  const std::string bridge = osm::find_tag(tags, "bridge");
  return !bridge.empty() && bridge != "no" && bridge != "boardwalk" &&
         bridge != "low_water_crossing";
}

int read_layer(const osm::OsmTags& tags) {
  const int usual = is_bridge(tags) ? 1 : 0;
  const auto found = tags.find("layer");
  if (found == tags.end()) return usual;
  std::string_view text = found->second;
  const auto number = osm::take_number(text);
  constexpr double most = 5;  // OSM wiki, "Key:layer"
  return number && std::abs(*number) <= most ? static_cast<int>(std::lround(*number)) : usual;
}

double find_half_width_m(const osm::OsmTags& tags, Carried kind) {
  if (kind == Carried::rail) {
    const ground_cover::TrackKind* track =
        ground_cover::find_track_kind(osm::find_tag(tags, "railway"));
    const ground_cover::Tracks tracks = ground_cover::read_tracks(tags, *track);
    return (ground_cover::TrackBed{}.width_m(tracks.gauges_m.back()) +
            (tracks.count - 1) * track->spacing_m) /
               2 +
           ledge_m;
  }
  const double kerb_m = roads::carriageway_width(tags) / 2,
               reach_m = ground_cover::find_street_reach_m(tags);
  const bool is_bare = kind == Carried::street && reach_m <= kerb_m;
  return is_bare ? kerb_m + cap_m : reach_m + ledge_m;
}

NodeKey to_key(const glm::dvec2& lon_lat) {
  return {std::llround(lon_lat.x * 1e7), std::llround(lon_lat.y * 1e7)};
}

PlacedWay place_way(const osm::OsmWay& way, Carried kind, const place::LonLatToFrame& to_frame) {
  PlacedWay placed{&way, kind, read_layer(way.tags), find_half_width_m(way.tags, kind), {}, {}};
  for (const glm::dvec2& lon_lat : way.lon_lat) {
    const glm::dvec2 place = to_frame(lon_lat);
    constexpr double farthest_m = 1e8;
    if (!finite(place) || std::max(std::abs(place.x), std::abs(place.y)) > farthest_m) continue;
    if (!placed.line.empty() && placed.line.back() == place) continue;
    placed.line.push_back(place);
    placed.lon_lat.push_back(lon_lat);
  }
  return placed;
}

}  // namespace nightcity::bridges
