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
  /// Upright surfaces of any object, E, N, H in metres; `owner` tells objects apart. 32 bytes a wall and 4 a
  /// cell it touches.
  void add(const CityObject& object, std::uint32_t owner);

  /// Whether a wall crosses the horizontal line from 5 cm behind `p` to `reach_m` before it along `normal`,
  /// at p's height. The owner's walls that face the same way are the window's own facade and do not count; a
  /// party wall faces the other way and does.
  bool blocked(const glm::dvec3& p, const glm::dvec3& normal, double reach_m, std::uint32_t owner) const;

  /// Whether `p` lies inside an object that is not its owner's: whoever walks from it along `normal` comes to
  /// the back of a wall first, and backwards to the back of another wall of the same object (a look over a
  /// low eave onto a high back wall meets only the first). Looks 30 m either way.
  bool inside_another(const glm::dvec3& p, const glm::dvec3& normal, std::uint32_t owner) const;

 private:
  struct Wall {
    float ax, ay, bx, by;  // plan, relative to origin_
    float low, high;
    float facing;  // angle of the outward normal
    std::uint32_t owner;
  };
  /// Calls visit(wall, t, same_way) for every wall that crosses the line, t in [0, 1] along it.
  template <class Visit>
  void crossings(const glm::dvec3& local, const glm::dvec2& from, const glm::dvec2& line,
                 const Visit& visit) const;

  std::optional<glm::dvec3> origin_;
  std::vector<Wall> walls_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace nightcity
