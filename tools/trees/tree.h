// A tree of the city, and when in the year it is seen.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

namespace nightcity::trees {

enum class Season : std::uint8_t { none, summer, winter };  // none: no trees

struct Tree {
  glm::dvec3 foot{0};      // E, N, H of the city's frame, m
  double height_m = 0;     // from foot to top
  double crown_m = 0;      // diameter of the crown
  double clear_m = 0;      // from foot to the lowest leaf
  double trunk_m = 0;      // diameter of the trunk
  bool evergreen = false;  // has its leaves in winter
  /// The number of the city model's tree that it is, or of the cover that it stands in; none of the
  /// map's.
  std::optional<std::uint32_t> of_model{};
};

}  // namespace nightcity::trees
