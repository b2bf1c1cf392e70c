// This is the one table of things that a bake can give up. `nightbake price` bakes each variant.
#pragma once

#include <string>
#include <vector>

#include "tools/bake/recipe/recipe.h"

namespace nightcity::bake {

/// A bake with something given up. A new one is a row in variants.cpp.
struct Variant {
  const char* name;
  const char* key;   // that a recipe writes for it: "[output] draco_tolerance_m = 0.01"
  const char* help;  // what is given up
  /// The largest distance by which it moves a point of a surface, m; 0 = none, or not bounded.
  double max_shift_m;
  /// Returns whether the recipe makes something of it that the variant gives up.
  bool (*applies)(const Recipe& recipe);
  void (*change)(Recipe& recipe);
};

const std::vector<Variant>& list_variants();

}  // namespace nightcity::bake
