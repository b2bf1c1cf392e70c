// What a building is used for, out of the codes and words that cities publish.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string_view>

#include "tools/city/city_model.h"

namespace nightcity {

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
  bool stated = false;    // by the model
  bool from_map = false;  // by the map, where the model says nothing; neither: a guess
};

/// What the map says at a place, where it says anything (OsmUses).
using UseAt = std::function<std::optional<BuildingUse>(const glm::dvec2&)>;

const char* name_of(BuildingUse use);

/// One code or word: ALKIS/AdV building functions ("31001_1120", "99999_2020"), PLATEAU usages ("411"), the
/// four-digit code list of CityGML 2.0, or words ("Wohnhaus", "office"). Unknown: not stated.
KnownUse use_from_code(std::string_view code);

/// From function, usage and class, in that order, then from the map at the middle of its footprint (where
/// `map` is given; coordinates E, N). Unknown buildings are dwellings, unknown huts (under 3 m or 25 m2)
/// dark.
KnownUse use_of(const CityObject& building, const UseAt& map = {});

}  // namespace nightcity
