// Reports the bridges of the map: how long they are, and why others lie on the ground.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/bridges/bridge_decks.h"

namespace nightcity::bake {

struct BridgesReport {
  bool has_bridges = false;  // false: the recipe or the city model wants none of the map's
  bridges::BridgeReport found;
  double deck_m2 = 0;  // in plan
  std::size_t triangles = 0, piers = 0;
  std::size_t bare_decks = 0;  // the outlines of what covers them cross too often
};

nlohmann::json to_json(const BridgesReport& report);
/// Returns "" where the map has no bridge.
std::string to_text(const BridgesReport& report);

}  // namespace nightcity::bake
