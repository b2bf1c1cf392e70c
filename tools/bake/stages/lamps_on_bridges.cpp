#include "tools/bake/stages/lamps_on_bridges.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace nightcity::bake {
namespace {

// A luminaire hangs so far below a deck, and has so much room above the ground at least: an
// assumption, and the height of a door.
constexpr double below_deck_m = 0.3, least_m = 2.0;

}  // namespace

void place_on_bridges(const CityBridges& bridges, lights::LampSet& lamps) {
  const place::DeckAt deck_at = bridges.deck_at();
  if (!deck_at || bridges.decks().empty()) return;
  std::erase_if(lamps.lamps, [&](lights::PlacedLamp& lamp) {
    if (const auto place = deck_at(lamp.way_id, glm::dvec2(lamp.foot))) {
      lamp.foot = *place;
      ++lamps.notes["on a bridge"];
    }
    std::optional<double> soffit = bridges.decks().find_soffit(lamp.foot);
    const glm::dvec3 below_luminaire = lamp.foot + glm::dvec3(lamp.outreach, 0);
    if (const auto above = bridges.decks().find_soffit(below_luminaire))
      soffit = std::min(soffit.value_or(*above), *above);
    if (!soffit) return false;
    const double room_m = *soffit - below_deck_m - lamp.foot.z;
    if (lamp.mounting_height_m <= room_m) return false;
    if (room_m < least_m) {
      ++lamps.left_out["no room below a bridge"];
      return true;
    }
    lamp.mounting_height_m = room_m;
    ++lamps.notes["lowered to hang below a bridge"];
    return false;
  });
}

}  // namespace nightcity::bake
