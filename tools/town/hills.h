// The ground of the town: gentle hills, sampled on the grid whose triangles the TINRelief holds.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

namespace nightcity::town {

class Hills {
 public:
  static constexpr double spacing_m = 10;  // of the terrain grid
  /// Height of roads above the terrain's facets. The curvature of the hills stays below 1.3e-3 / m,
  /// so that the distance of a facet and a road slab differs from it by less than 6 cm.
  static constexpr double road_lift_m = 0.08;
  static constexpr double pavement_lift_m = 0.20;  // a 12 cm kerb

  Hills(std::uint64_t seed, double relief_m);

  /// Returns the height of the smooth surface, m above the datum; `p` in metres from the town's
  /// origin.
  double smooth(const glm::dvec2& p) const;
  /// Returns the height of the terrain as written: linear on the triangles of the grid.
  double height(const glm::dvec2& p) const;
  double lowest() const { return base_m_ - relief_m_ / 2; }
  double highest() const { return base_m_ + relief_m_ / 2; }

 private:
  double base_m_ = 58, relief_m_;
  glm::dvec2 wave_[3];
  double phase_[3];
};

}  // namespace nightcity::town
