#include "runtime/render/pass_constants.h"

#include "runtime/render/setting_table.h"

namespace nightcity::render {

bool has_air(const RenderSettings& settings) {
  return settings.air.visibility_km > 0 || (settings.forced_features >> CONSTANT_AIR & 1u) != 0;
}

PassConstants find_constants(const RenderSettings& settings, const scene::SceneTraits& traits) {
  PassConstants constants{};
  constants[CONSTANT_ESTIMATOR] = static_cast<std::uint32_t>(settings.sampling.estimator);
  constants[CONSTANT_PROFILES] = traits.profiles;
  constants[CONSTANT_RECTANGLES] = traits.rectangles;
  constants[CONSTANT_VISIBILITY_REUSE] = settings.reuse.visibility_reuse;
  const bool sky = settings.environment.sky_cd_m2 != glm::vec3(0),
             moon = settings.environment.moon_lux != glm::vec3(0);
  constants[CONSTANT_SKY] = sky && traits.sky_map ? SKY_MAP : sky || moon ? SKY_UNIFORM : SKY_DARK;
  constants[CONSTANT_GLOSS] = settings.environment.wetness > 0 || traits.water;
  constants[CONSTANT_LAYERS] = settings.sampling.layers;
  constants[CONSTANT_SCHEDULES] =
      traits.schedules || settings.environment.lights != scene::all_families;
  constants[CONSTANT_TRAFFIC] = traits.traffic;
  constants[CONSTANT_COUNT_RAYS] = settings.count_rays;
  constants[CONSTANT_INDIRECT] = find_indirect(settings);
  constants[CONSTANT_AIR] = !has_air(settings)          ? AIR_CLEAR
                            : settings.air.height_m > 0 ? AIR_LAYERED
                                                        : AIR_EVEN;
  constants[CONSTANT_TEXTURES] = traits.textures;
  constants[CONSTANT_PROJECTION] = settings.projection;
  for (const Feature& feature : optional_features())
    if ((settings.forced_features >> feature.constant & 1u) != 0 &&
        constants[feature.constant] == 0)
      constants[feature.constant] = 1;
  return constants;
}

std::vector<Feature> list_unneeded(const RenderSettings& settings, const DeviceScene& scene) {
  const PassConstants constants = find_constants(settings, scene.traits());
  std::vector<Feature> features;
  for (const Feature& feature : optional_features())
    if (constants[feature.constant] == 0) features.push_back(feature);
  return features;
}

}  // namespace nightcity::render
