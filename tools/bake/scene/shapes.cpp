#include "tools/bake/scene/shapes.h"

#include <cmath>
#include <numbers>

namespace nightcity::bake {

ScenePrimitive make_prism(float radius, std::uint32_t sides, std::uint32_t material) {
  ScenePrimitive p;
  p.material = material;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    const auto x = static_cast<float>(std::cos(angle)) * radius,
               z = static_cast<float>(-std::sin(angle)) * radius;
    p.positions.insert(p.positions.end(), {{x, 0, z}, {x, 1, z}});
  }
  const std::uint32_t top = 2 * sides;
  p.positions.push_back({0, 1, 0});
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
    p.indices.insert(p.indices.end(), {a, b, b + 1, a, b + 1, a + 1, a + 1, b + 1, top});
  }
  return p;
}

ScenePrimitive make_box(std::uint32_t material) {
  ScenePrimitive p;
  p.material = material;
  for (const float x : {-0.5f, 0.5f})
    for (const float y : {0.0f, 1.0f})
      for (const float z : {-0.5f, 0.5f}) p.positions.push_back({x, y, z});
  p.indices = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
               2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
  return p;
}

}  // namespace nightcity::bake
