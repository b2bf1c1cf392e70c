// The bridges of a city's map: their decks, and what covers these.
#pragma once

#include <map>
#include <vector>

#include "tools/bridges/bridge_decks.h"
#include "tools/ground_cover/cover.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"

namespace nightcity::bake {

struct BridgeOptions {
  bool markings = true, rails = true;
  bool drives_on_the_left = false;
};

class CityBridges {
 public:
  /// Finds the decks over the ground as it is without streets, and covers them.
  void build(const osm::OsmData& map, const place::LonLatToFrame& to_frame,
             const place::HeightAt& height_at, const BridgeOptions& options);

  /// Returns whether bridges of the map are built where they can be.
  bool built() const { return built_; }
  const bridges::BridgeDecks& decks() const { return decks_; }
  /// Returns what covers the decks of each layer.
  const std::map<int, ground_cover::Cover>& covers() const { return covers_; }

  /// Returns the place on a deck, as it is covered, for what stands or drives beside or on a way:
  /// none where the way lies on the ground there. Empty where no bridges are built.
  place::DeckAt deck_at() const;

 private:
  bool built_ = false;
  bridges::BridgeDecks decks_;
  std::map<int, ground_cover::Cover> covers_;
};

}  // namespace nightcity::bake
