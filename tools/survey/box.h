// Boxes of longitude and latitude.
#pragma once

#include <glm/vec2.hpp>
#include <limits>

namespace nightcity::survey {

/// A box of WGS 84 degrees. Of one across the antimeridian, longitudes count on beyond 180 or -180.
struct Box {
  glm::dvec2 least{std::numeric_limits<double>::infinity()}, greatest{-least};
  void add(glm::dvec2 lon_lat);
  bool empty() const { return !(least.x <= greatest.x); }
  glm::dvec2 middle() const { return (least + greatest) / 2.0; }
  /// Returns whether the boxes are nearer to each other than this.
  bool is_near(const Box& other, double degrees) const;
};

}  // namespace nightcity::survey
