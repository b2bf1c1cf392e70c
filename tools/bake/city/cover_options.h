// Options of what covers the ground of a city.
#pragma once

namespace nightcity::bake {

struct CoverOptions {
  bool streets = true;   // of the map, where the model has no roads
  bool markings = true;  // on those streets
  bool land = true;      // of the map, where the model has none
};

}  // namespace nightcity::bake
