// The ways of a map sorted by where they lie: on the ground, or on the decks of a layer.
#pragma once

#include <span>
#include <vector>

#include "tools/bridges/bridge_decks.h"

namespace nightcity::bridges {

/// Returns the ways as they lie on the ground: those that decks carry only as far as the deck still
/// lies in the ground there, and without the tags that say that they are above it.
std::vector<osm::OsmWay> find_ground_ways(std::span<const osm::OsmWay> ways,
                                          const BridgeDecks& decks,
                                          const place::LonLatToFrame& to_frame);
/// Returns the ways that decks of a layer carry, without the same tags.
std::vector<osm::OsmWay> find_deck_ways(std::span<const osm::OsmWay> ways, const BridgeDecks& decks,
                                        int layer);

}  // namespace nightcity::bridges
