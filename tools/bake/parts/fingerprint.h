// The fingerprint of a bake's recipe and inputs: parts of one bake have the same.
#pragma once

#include <string>

#include "tools/bake/city/city_inputs.h"

namespace nightcity::bake {

/// Returns 16 hexadecimal digits: a hash (XXH64) of the program's version, the recipe's text, and
/// name (as seen from the recipe's folder), size and time of change of each file of the city model,
/// the map and elevation models, and of what lies beside a city file or below and may be named in it:
/// pictures, where [city] textures has them read, and libraries of colours of Wavefront OBJ. Throws
/// Error where one of them is missing.
std::string make_fingerprint(const CityInputs& inputs, const std::string& version);

}  // namespace nightcity::bake
