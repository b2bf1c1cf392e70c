#include "tools/barriers/openings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <optional>

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
  const std::string value = osm::find_tag(tags, "barrier");
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
    for (const glm::dvec2& p : way.lon_lat) openings_.try_emplace(p);
  for (const osm::OsmWay& way : map.highways) {
    // The outline of a square runs along the walls around it.
    if (osm::says_area(way.tags)) continue;
    const double width_m = roads::carriageway_width(way.tags);
    for (std::size_t i = 0; i < way.lon_lat.size(); ++i) {
      const auto known = openings_.find(way.lon_lat[i]);
      if (known == openings_.end()) continue;
      if (i > 0) known->second.passages.push_back({width_m, way.lon_lat[i - 1]});
      if (i + 1 < way.lon_lat.size())
        known->second.passages.push_back({width_m, way.lon_lat[i + 1]});
    }
  }
  for (const osm::OsmPoint& gate : map.gates) {
    const auto known = openings_.find(gate.lon_lat);
    if (known == openings_.end()) continue;
    Opening& opening = known->second;
    const auto said_m = tagged_width(gate.tags);
    if (said_m)
      opening.gate_m = *said_m, opening.is_said = true;
    else if (!opening.is_said)
      opening.gate_m = std::max(opening.gate_m, usual_width(gate.tags));
  }
}

double Openings::width_at(const glm::dvec2& lon_lat) const {
  const auto known = openings_.find(lon_lat);
  if (known == openings_.end()) return 0;
  double width_m = known->second.gate_m;
  if (!known->second.is_said)
    for (const Passage& one : known->second.passages) width_m = std::max(width_m, one.width_m);
  return width_m;
}

double Openings::length_along(const glm::dvec2& lon_lat, const glm::dvec2& along,
                              double thickness_m, const place::LonLatToFrame& to_frame) const {
  double length_m = width_at(lon_lat);
  const auto known = openings_.find(lon_lat);
  if (known == openings_.end() || known->second.is_said) return length_m;
  constexpr double min_sine = 0.3;  // of 17 degrees
  const glm::dvec2 node = to_frame(lon_lat);
  for (const Passage& one : known->second.passages) {
    const glm::dvec2 away = to_frame(one.towards) - node;
    const double away_m = glm::length(away);
    if (!(away_m > 0)) continue;
    const double sine = std::abs(along.x * away.y - along.y * away.x) / away_m,
                 cosine = std::abs(glm::dot(along, away)) / away_m;
    length_m = std::max(length_m, (one.width_m + thickness_m * cosine) / std::max(sine, min_sine));
  }
  return length_m;
}

}  // namespace nightcity::barriers
