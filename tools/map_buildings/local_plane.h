// Metres round a place of a map.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace nightcity::map_buildings {

/// A plane in metres round a place: distances on the ellipsoid of WGS 84 along its meridian and its
/// parallel (Snyder 1987, "Map Projections", 25), good to a millimetre over a building.
class LocalPlane {
 public:
  explicit LocalPlane(const glm::dvec2& origin) : origin_(origin) {
    constexpr double semi_major_m = 6'378'137, eccentricity2 = 0.00669437999014;
    constexpr double degree = std::numbers::pi / 180;
    const double sine = std::sin(origin.y * degree);
    const double w2 = 1 - eccentricity2 * sine * sine;
    metres_a_degree_ = {
        degree * semi_major_m * std::max(std::cos(origin.y * degree), 1e-6) / std::sqrt(w2),
        degree * semi_major_m * (1 - eccentricity2) / (w2 * std::sqrt(w2))};
  }
  glm::dvec2 to_metres(const glm::dvec2& lon_lat) const {
    return (lon_lat - origin_) * metres_a_degree_;
  }
  glm::dvec3 to_degrees(const glm::dvec3& p) const {
    return {origin_ + glm::dvec2(p) / metres_a_degree_, p.z};
  }

 private:
  glm::dvec2 origin_, metres_a_degree_;
};

}  // namespace nightcity::map_buildings
