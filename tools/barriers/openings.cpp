#include "tools/barriers/openings.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "tools/ground_cover/way_line.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/tag_values.h"
#include "tools/roads/carriageway.h"

namespace nightcity::barriers {
namespace {

constexpr double people_m = 0.90, vehicles_m = 3.00;

std::optional<double> tagged_width(const osm::OsmTags& tags) {
  return osm::find_length_m(tags, {"width", "maxwidth", "maxwidth:physical"}, 0.5, 20);
}

double usual_width(const osm::OsmTags& tags) {
  const std::string value = ground_cover::tag_of(tags, "barrier");
  const bool for_vehicles =
      value == "lift_gate" || value == "swing_gate" || value == "sliding_gate";
  return for_vehicles ? vehicles_m : people_m;
}

}  // namespace

std::size_t Openings::Hash::operator()(const glm::dvec2& p) const {
  const std::hash<double> hash;
  return hash(p.x) * 31 + hash(p.y);
}

Openings::Openings(const osm::OsmData& map) {
  for (const osm::OsmWay& way : map.barriers)
    for (const glm::dvec2& p : way.lon_lat) widths_.try_emplace(p, 0.0);
  for (const osm::OsmWay& way : map.highways) {
    // The outline of a square runs along the walls around it.
    if (osm::says_area(way.tags)) continue;
    const double width_m = roads::carriageway_width(way.tags);
    for (const glm::dvec2& p : way.lon_lat) widen(p, width_m);
  }
  for (const osm::OsmPoint& gate : map.gates) {
    const auto width_m = tagged_width(gate.tags);
    if (const auto known = widths_.find(gate.lon_lat); width_m && known != widths_.end())
      known->second = *width_m;
    else
      widen(gate.lon_lat, usual_width(gate.tags));
  }
}

void Openings::widen(const glm::dvec2& lon_lat, double width_m) {
  if (const auto known = widths_.find(lon_lat); known != widths_.end())
    known->second = std::max(known->second, width_m);
}

double Openings::width_at(const glm::dvec2& lon_lat) const {
  const auto known = widths_.find(lon_lat);
  return known == widths_.end() ? 0 : known->second;
}

}  // namespace nightcity::barriers
