// The use of a building, from the codes and words that cities publish.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string_view>

#include "tools/city/city_model.h"

namespace nightcity::lights {

enum class BuildingUse {
  residential,
  mixed,  // shops below, dwellings above
  office,
  retail,  // shops, restaurants
  hotel,
  education,
  civic,  // administration, culture, health
  industrial,
  dark  // garages, sheds, greenhouses, churches, plant: no lit rooms
};

struct KnownUse {
  BuildingUse use = BuildingUse::residential;
  bool stated = false;    // the model says so
  bool from_map = false;  // the map says so, where the model says nothing; neither: assumed
};

/// Returns the use that the map gives at a place; empty where it gives none (OsmUses).
using UseAt = std::function<std::optional<BuildingUse>(const glm::dvec2&)>;

const char* name_of(BuildingUse use);

/// Returns the use for one code or word: ALKIS/AdV building functions ("31001_1120", "99999_2020"),
/// PLATEAU usages ("411"), the four-digit code list of CityGML 2.0, or words ("Wohnhaus",
/// "office"). For an unknown code the result is not `stated`.
KnownUse use_from_code(std::string_view code);

/// Returns the use of a building from its function, usage and class, in that order, then from the
/// map at the middle of its box or, where that is not below its roof, at a place below it (if `map`
/// is given; coordinates E, N). Unknown buildings are dwellings, and unknown huts (under 3 m or
/// 25 m2) are dark.
KnownUse use_of(const city::CityObject& building, const UseAt& map = {});

}  // namespace nightcity::lights
