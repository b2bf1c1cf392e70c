// Finds streets by a part of their name.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "formats/scene_places.h"

namespace nightcity::scene {

/// Returns the streets one of whose names contains `text`, whatever its case and diacritics
/// (fold_name), the best first: the name itself, names that begin with it, those in which a word does, others; of
/// equal rank names before other names (NamedStreet::also), shorter ones first, and of one name the
/// longest street.
std::vector<std::size_t> find_streets(std::span<const NamedStreet> streets,
                                      const std::string& text);

}  // namespace nightcity::scene
