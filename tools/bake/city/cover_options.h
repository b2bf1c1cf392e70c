// Options of what a map adds to a city: what covers its ground and stands on it, and buildings that
// the model lacks.
#pragma once

#include <optional>

#include "tools/traffic/country.h"
#include "tools/trees/tree.h"

namespace nightcity::bake {

struct CoverOptions {
  bool streets = true;                  // of the map, where the model has no roads
  bool markings = true;                 // on those streets
  bool lowered_kerbs = true;            // where people cross them
  bool rounded_corners = true;          // of carriageways where they meet
  std::optional<traffic::Side> side{};  // of the road that vehicles keep to; empty: by country
  bool parking = true;                  // lanes and bays along those streets
  bool rails = true;                    // of the map, where the model has no roads
  bool bridges = true;                  // of the map, above the ground, where the model has none
  bool land = true;                     // of the map, where the model has none
  bool gaps = true;                     // buildings of the map, where the model has none
  bool barriers = true;                 // of the map
  bool steps = true;                    // of those streets, with treads and risers
  bool horizon = true;                  // the ground goes on beyond its edge
  trees::Season trees = trees::Season::summer;
};

}  // namespace nightcity::bake
