// Latitudes and longitudes of a scene, and names of its streets.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "formats/geographic_fit.h"

namespace nightcity {

/// A street, or a square, by its name in the map. Streets of one name that lie apart are several.
struct NamedStreet {
  std::string name;  // UTF-8
  /// Centrelines in model space: x and z, m. A line of one point is the middle of a square.
  std::vector<std::vector<glm::dvec2>> lines;
  std::vector<std::string> also{};  // other names, by which it is found: none is `name`
};

struct ScenePlaces {
  std::optional<GeographicFit> geographic;
  std::vector<NamedStreet> streets;
};

/// Bounds of what a file may hold: names have the 255 characters of OpenStreetMap's tags at most.
constexpr std::size_t max_street_name_bytes = 1020, max_street_points = 1'000'000;
constexpr std::size_t max_other_names = 32;  // of a street

}  // namespace nightcity
