#include "tools/bridges/deck_ways.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "tools/place/between.h"

namespace nightcity::bridges {
namespace {

osm::OsmTags drop_bridge_tags(osm::OsmTags tags) {
  for (const char* key : {"bridge", "layer", "level"}) tags.erase(key);
  return tags;
}

// Returns the part of a line between two distances from its start.
std::vector<glm::dvec2> cut(const PlacedWay& way, double from_m, double to_m,
                            const place::LonLatToFrame& to_frame) {
  std::vector<glm::dvec2> part;
  double at_m = 0;
  for (std::size_t i = 0; i + 1 < way.line.size(); ++i) {
    const double length_m = glm::distance(way.line[i], way.line[i + 1]);
    const double from = std::max(from_m, at_m), to = std::min(to_m, at_m + length_m);
    if (from < to) {
      const auto at = [&](double s) {
        return place::find_between(way.lon_lat[i], way.lon_lat[i + 1], (s - at_m) / length_m,
                                   to_frame);
      };
      if (part.empty()) part.push_back(at(from));
      part.push_back(at(to));
    }
    at_m += length_m;
  }
  return part;
}

void add_ends(const osm::OsmWay& way, const BridgeDecks::Lifted& lifted, const Deck& deck,
              const place::LonLatToFrame& to_frame, std::vector<osm::OsmWay>& out) {
  const PlacedWay placed = place_way(way, deck.kind, to_frame);
  const double sign = lifted.reversed ? -1 : 1;
  const std::pair<double, double> stretches[2] = {
      {0, deck.in_ground_m[0]}, {deck.length_m() - deck.in_ground_m[1], deck.length_m()}};
  for (const auto& [from_m, to_m] : stretches) {
    if (!(from_m < to_m)) continue;
    const double a = (from_m - lifted.from_m) * sign, b = (to_m - lifted.from_m) * sign;
    std::vector<glm::dvec2> part = cut(placed, std::min(a, b), std::max(a, b), to_frame);
    if (part.size() > 1) out.push_back({way.id, std::move(part), drop_bridge_tags(way.tags)});
  }
}

}  // namespace

std::vector<osm::OsmWay> find_ground_ways(std::span<const osm::OsmWay> ways,
                                          const BridgeDecks& decks,
                                          const place::LonLatToFrame& to_frame) {
  std::vector<osm::OsmWay> out;
  for (const osm::OsmWay& way : ways) {
    const BridgeDecks::Lifted* lifted = decks.find(way.id);
    if (!lifted)
      out.push_back(way);
    else if (!lifted->is_guest)
      add_ends(way, *lifted, decks.decks()[lifted->deck], to_frame, out);
  }
  return out;
}

std::vector<osm::OsmWay> find_deck_ways(std::span<const osm::OsmWay> ways, const BridgeDecks& decks,
                                        int layer) {
  std::vector<osm::OsmWay> out;
  for (const osm::OsmWay& way : ways)
    if (const BridgeDecks::Lifted* lifted = decks.find(way.id);
        lifted && decks.decks()[lifted->deck].layer == layer)
      out.push_back({way.id, way.lon_lat, drop_bridge_tags(way.tags)});
  return out;
}

}  // namespace nightcity::bridges
