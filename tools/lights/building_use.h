// What a building is used for, out of the codes and words that cities publish.
#pragma once

#include <string_view>

#include "tools/citygml/city_model.h"

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
  bool stated = false;  // by the model; otherwise a guess
};

const char* name_of(BuildingUse use);

/// One code or word: ALKIS/AdV building functions ("31001_1120", "99999_2020"), PLATEAU usages ("411"), the
/// four-digit code list of CityGML 2.0, or words ("Wohnhaus", "office"). Unknown: not stated.
KnownUse use_from_code(std::string_view code);

/// From function, usage and class, in that order; unknown buildings are dwellings, unknown huts (under 3 m or
/// 25 m2) dark.
KnownUse use_of(const CityObject& building);

}  // namespace nightcity
