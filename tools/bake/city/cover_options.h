// Options of what a map adds to a city: what covers its ground, and buildings that the model lacks.
#pragma once

#include "tools/trees/tree.h"

namespace nightcity::bake {

struct CoverOptions {
  bool streets = true;   // of the map, where the model has no roads
  bool markings = true;  // on those streets
  bool land = true;      // of the map, where the model has none
  bool gaps = true;      // buildings of the map, where the model has none
  trees::Season trees = trees::Season::summer;
};

}  // namespace nightcity::bake
