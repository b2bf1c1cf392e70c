#include <algorithm>

#include "runtime/render/renderer.h"

namespace nightcity {

DeviceScene::DeviceScene(gpu::Device& device, const RenderScene& scene) {
  const auto store = [&](const auto& values) {
    storage_.push_back(gpu::Buffer::of(device, std::span(values)));
    return storage_.back().address();
  };
  addresses_.nodes = store(scene.nodes);
  addresses_.triangles = store(scene.triangles);
  addresses_.instances = store(scene.instances);
  addresses_.materials = store(scene.materials);
  addresses_.lights = store(scene.lights);
  addresses_.profiles = store(scene.profiles);
  addresses_.profile_data = store(scene.profile_data);
  addresses_.alias = store(scene.alias);
  addresses_.cells = store(scene.grid.cells);
  addresses_.local_entries = store(scene.grid.entries);
  addresses_.grid = scene.grid.shape;
  addresses_.root = scene.root;
  addresses_.light_count = static_cast<std::uint32_t>(scene.lights.size());
  has_profiles_ = std::any_of(scene.lights.begin(), scene.lights.end(),
                              [](const Light& light) { return light.kind_profile >> 8 != LIGHT_NO_PROFILE; });
  has_rectangles_ = std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
    return (light.kind_profile & 255u) == LIGHT_RECTANGLE;
  });
}

std::uint64_t DeviceScene::bytes() const {
  std::uint64_t total = 0;
  for (const gpu::Buffer& buffer : storage_) total += buffer.bytes();
  return total;
}

}  // namespace nightcity
