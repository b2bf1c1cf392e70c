#include "tools/bake/city/city_bridges.h"

#include <glm/common.hpp>
#include <optional>
#include <utility>

#include "tools/bridges/deck_ways.h"
#include "tools/ground_cover/rail_areas.h"
#include "tools/ground_cover/street_areas.h"

namespace nightcity::bake {
namespace {

std::map<int, ground_cover::Box> find_boxes(const bridges::BridgeDecks& decks) {
  std::map<int, ground_cover::Box> boxes;
  for (const bridges::Deck& deck : decks.decks()) {
    ground_cover::Box& box = boxes.try_emplace(deck.layer, deck.box).first->second;
    box = {glm::min(box.low, deck.box.low), glm::max(box.high, deck.box.high)};
  }
  return boxes;
}

}  // namespace

void CityBridges::build(const osm::OsmData& map, const place::LonLatToFrame& to_frame,
                        const place::HeightAt& height_at, const BridgeOptions& options) {
  built_ = true;
  const std::vector<osm::OsmWay> no_railways;
  decks_ = bridges::find_decks({map.highways, options.rails ? map.railways : no_railways}, to_frame,
                               height_at);
  for (const auto& [layer, bounds] : find_boxes(decks_)) {
    ground_cover::Cover& cover = covers_[layer];
    const auto streets = bridges::find_deck_ways(map.highways, decks_, layer);
    const bool bays = false;  // no one parks on a bridge
    ground_cover::add_streets(streets, bays, to_frame, bounds, cover);
    if (options.markings)
      ground_cover::add_markings(
          {streets, map.controls, map.crossings, options.drives_on_the_left, bays}, to_frame,
          bounds, cover);
    if (options.rails)
      ground_cover::add_rails(bridges::find_deck_ways(map.railways, decks_, layer), to_frame,
                              bounds, cover);
    cover.finish();
  }
}

place::DeckAt CityBridges::deck_at() const {
  if (!built_) return {};
  return [this](std::int64_t way_id, const glm::dvec2& place) -> std::optional<glm::dvec3> {
    auto found = decks_.find_place(way_id, place);
    if (!found) return found;
    const int layer = decks_.decks()[decks_.find(way_id)->deck].layer;
    found->z -= covers_.at(layer).depth_at(glm::dvec2(*found));
    return found;
  };
}

}  // namespace nightcity::bake
