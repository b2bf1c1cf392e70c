// Small scenes for tests.
#pragma once

#include "formats/scene.h"

namespace nightcity::test {

/// Returns a horizontal square of two triangles, centred on the origin, with sides of `size` m.
inline ScenePrimitive square(float size, std::uint32_t material = 0) {
  const float h = size / 2;
  ScenePrimitive primitive;
  primitive.material = material;
  primitive.positions = {{-h, 0, h}, {h, 0, h}, {h, 0, -h}, {-h, 0, -h}};
  primitive.indices = {0, 1, 2, 0, 2, 3};
  return primitive;
}

/// Returns `count` squares in rows, each a feature of its own.
inline ScenePrimitive field(std::uint32_t count, std::uint32_t material = 0) {
  ScenePrimitive result;
  result.material = material;
  for (std::uint32_t i = 0; i < count; ++i) {
    const ScenePrimitive one = square(0.9f);
    const auto base = static_cast<std::uint32_t>(result.positions.size());
    const glm::vec3 place(static_cast<float>(i % 200), static_cast<float>(i % 7),
                          static_cast<float>(i / 200));
    for (const glm::vec3& p : one.positions) result.positions.push_back(p + place);
    for (const std::uint32_t index : one.indices) result.indices.push_back(base + index);
  }
  return result;
}

}  // namespace nightcity::test
