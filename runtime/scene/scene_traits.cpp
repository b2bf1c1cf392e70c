#include "runtime/scene/scene_traits.h"

#include <algorithm>

#include "runtime/scene/parts.h"
#include "shaders/scene_types.h"

namespace nightcity::scene {
namespace {

SceneTraits find_light_traits(const RenderScene& scene) {
  const auto any_light = [&](auto&& is) {
    return std::any_of(scene.lights.begin(), scene.lights.end(), is) ||
           std::any_of(scene.traffic.vehicle_lights.begin(), scene.traffic.vehicle_lights.end(),
                       is);
  };
  SceneTraits traits;
  traits.profiles =
      any_light([](const Light& light) { return light_profile(light) != LIGHT_NO_PROFILE; });
  traits.rectangles =
      any_light([](const Light& light) { return light_kind(light) == LightKind::rectangle; });
  traits.schedules = !scene.schedules.empty() &&
                     std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
                       return light.schedule != LIGHT_ALWAYS_ON;
                     });
  traits.traffic = !scene.traffic.trips.empty();
  return traits;
}

}  // namespace

SceneTraits find_traits(const RenderScene& scene) {
  SceneTraits traits = find_light_traits(scene);
  traits.water = scene.triangles.any_material([&](std::uint32_t material) {
    return material < scene.materials.size() &&
           scene.materials[material].roughness < WATER_ROUGHNESS;
  });
  traits.textures = !scene.textures.empty();
  traits.sky_map = scene.sky_map.width > 0;
  return traits;
}

SceneTraits expect_traits(const RenderScene& scene, const Scene& header,
                          const std::vector<bool>& used_materials) {
  const auto any_material = [&](auto&& is) {
    for (std::size_t i = 0; i < std::min(header.materials.size(), used_materials.size()); ++i)
      if (used_materials[i] && is(header.materials[i])) return true;
    return false;
  };
  SceneTraits traits = find_light_traits(scene);
  traits.water = !holds(scene.left_out, Part::water) &&
                 any_material([](const SceneMaterial& m) { return m.roughness < WATER_ROUGHNESS; });
  traits.textures = !holds(scene.left_out, Part::textures) &&
                    !holds(scene.left_out, Part::colours) &&
                    any_material([](const SceneMaterial& m) { return m.texture.has_value(); });
  return traits;
}

}  // namespace nightcity::scene
