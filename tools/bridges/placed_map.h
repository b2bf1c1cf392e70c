// The ways of a map that may be bridges or pass below some, in the city's frame.
#pragma once

#include <set>
#include <vector>

#include "tools/bridges/bridge_decks.h"

namespace nightcity::bridges {

struct PlacedMap {
  std::vector<PlacedWay> ways, bridges;  // all, and those that are bridges
  GroundNodes ground;
  std::set<NodeKey> stairs;  // nodes of steps and lifts
};

/// Places the ways in an order that their lines alone decide, whatever their ids.
PlacedMap place_map(const BridgeMap& map, const place::LonLatToFrame& to_frame);

}  // namespace nightcity::bridges
