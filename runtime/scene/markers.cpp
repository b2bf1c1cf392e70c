#include "runtime/scene/markers.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace nightcity::scene {

std::optional<glm::vec2> project(const gpu::Camera& camera, const glm::vec3& position) {
  constexpr float nearest_m = 0.05f;
  const glm::vec3 offset = position - camera.position;
  const float depth = glm::dot(offset, camera.forward);
  if (!(depth > nearest_m)) return std::nullopt;
  const float half_height = depth * camera.tan_half_height;
  return glm::vec2(0.5f + 0.5f * glm::dot(offset, camera.right) / (half_height * camera.aspect),
                   0.5f - 0.5f * glm::dot(offset, camera.up) / half_height);
}

std::vector<Marker> find_markers(const gpu::Camera& camera, std::span<const Light> lights,
                                 std::size_t most) {
  std::vector<Marker> markers;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const std::optional<glm::vec2> at = project(camera, lights[i].position);
    if (!at || at->x < 0 || at->x > 1 || at->y < 0 || at->y > 1) continue;
    markers.push_back({*at, glm::distance(camera.position, lights[i].position), i});
  }
  const auto nearer = [](const Marker& a, const Marker& b) { return a.distance < b.distance; };
  if (markers.size() > most) {
    std::nth_element(markers.begin(), markers.begin() + static_cast<std::ptrdiff_t>(most),
                     markers.end(), nearer);
    markers.resize(most);
  }
  std::sort(markers.begin(), markers.end(),
            [&](const Marker& a, const Marker& b) { return nearer(b, a); });
  return markers;
}

}  // namespace nightcity::scene
