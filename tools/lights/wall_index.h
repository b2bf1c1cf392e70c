// Walls of the whole city, for one question: does something stand right before this window?
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <unordered_map>
#include <vector>

#include "tools/citygml/city_model.h"

namespace nightcity {

class WallIndex {
 public:
  /// Upright surfaces of any object, E, N, H in metres. 28 bytes a wall and cell it touches.
  void add(const CityObject& object);

  /// Whether a wall crosses the horizontal line from 5 cm behind `p` to `reach_m` before it along `normal`,
  /// at p's height. Walls that face the same way are the window's own facade and do not count; a party wall
  /// faces the other way and does.
  bool blocked(const glm::dvec3& p, const glm::dvec3& normal, double reach_m) const;

 private:
  struct Wall {
    float ax, ay, bx, by;  // plan, relative to origin_
    float low, high;
    float facing;  // angle of the outward normal
  };
  std::optional<glm::dvec3> origin_;
  std::vector<Wall> walls_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace nightcity
