// The words that people write in the tags of street lamps. All functions take a word as
// normalise_tag leaves it, and return nothing for a word that is not in their table.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

#include "tools/lights/lamp_tags.h"

namespace nightcity::lights {

/// Returns what a lamp is mounted on ("straight_mast", "wall", "catenary").
std::optional<LampMount> find_lamp_mount(std::string_view word);
/// Returns the type of a lamp ("led", "sodium", "hqi").
std::optional<LampType> find_lamp_type(std::string_view word);
/// Returns the colour temperature of a market name ("warm_white") in kelvin.
std::optional<double> find_cct_k(std::string_view word);

}  // namespace nightcity::lights
