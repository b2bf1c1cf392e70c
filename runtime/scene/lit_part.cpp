#include "runtime/scene/lit_part.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace nightcity::scene {
namespace {

glm::vec3 lights_median(const RenderScene& scene) {
  glm::vec3 median(0);
  std::vector<float> values(scene.lights.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(scene.lights.begin(), scene.lights.end(), values.begin(),
                   [&](const Light& light) { return light.position[axis]; });
    std::nth_element(values.begin(),
                     values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    median[axis] = values[values.size() / 2];
  }
  return median;
}

}  // namespace

LitPart find_lit_part(const RenderScene& scene) {
  if (scene.bounds.empty()) return {glm::vec3(0), 10};
  const glm::vec3 middle = 0.5f * (scene.bounds.lower + scene.bounds.upper);
  const glm::vec3 size = scene.bounds.upper - scene.bounds.lower;
  if (scene.lights.size() < 4)
    return {{middle.x, scene.bounds.lower.y, middle.z},
            std::max(1.0f, 0.5f * std::max(size.x, size.z))};
  const glm::vec3 centre = lights_median(scene);
  std::vector<float> distances;
  for (const Light& light : scene.lights)
    distances.push_back(std::hypot(light.position.x - centre.x, light.position.z - centre.z));
  const auto nth = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() * 9 / 10);
  std::nth_element(distances.begin(), nth, distances.end());
  return {centre, std::clamp(*nth, 20.0f, 600.0f)};
}

}  // namespace nightcity::scene
