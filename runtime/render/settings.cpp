#include "runtime/render/settings.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "formats/error.h"

namespace nightcity::render {

namespace {

EstimatorTraits describe(Estimator estimator, const char* name, const char* description) {
  const auto number = static_cast<std::uint32_t>(estimator);
  return {estimator,
          name,
          description,
          gpu::samples_lights(number),
          gpu::reuses_reservoirs(number),
          gpu::has_shadowed_target(number),
          gpu::reuse_weights(number) == WEIGHTS_PAIRWISE,
          gpu::has_published_settings(number)};
}

}  // namespace

const std::vector<EstimatorTraits>& list_estimators() {
  static const std::vector<EstimatorTraits> estimators{
      describe(Estimator::reference, "reference",
               "every light in every frame: the ground truth of all measurements"),
      describe(Estimator::ris, "ris", "resampled candidates without reuse: unbiased, noisy"),
      describe(Estimator::paper, "paper",
               "temporal and spatial reuse with 1/M weights, as published: biased, darker"),
      describe(Estimator::basic, "basic",
               "reuse with balance-heuristic normalisation of unshadowed targets: unbiased"),
      describe(Estimator::pairwise, "pairwise",
               "reuse with pairwise MIS of unshadowed targets: unbiased"),
      describe(Estimator::traced, "traced",
               "reuse with pairwise MIS of shadowed targets: unbiased, more shadow rays"),
  };
  return estimators;
}

const EstimatorTraits& traits_of(Estimator estimator) {
  for (const EstimatorTraits& traits : list_estimators())
    if (traits.estimator == estimator) return traits;
  throw UsageError("--estimator", "no estimator has the number " +
                                      std::to_string(static_cast<std::uint32_t>(estimator)));
}

const char* name_of(Estimator estimator) {
  return traits_of(estimator).name;
}

Estimator find_estimator(const std::string& name) {
  std::string known;
  for (const EstimatorTraits& traits : list_estimators()) {
    if (name == traits.name) return traits.estimator;
    known += (known.empty() ? "" : ", ") + std::string(traits.name);
  }
  throw UsageError("--estimator", "no estimator '" + name + "' (there are " + known + ")");
}

void set_moon(EnvironmentSettings& environment, double azimuth_deg, double elevation_deg,
              double lux) {
  const glm::vec3 colour(1.16f, 0.97f, 0.80f);  // of luminance 1
  const double a = glm::radians(azimuth_deg), e = glm::radians(elevation_deg);
  environment.moon_direction =
      glm::vec3(std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e));
  environment.moon_lux = static_cast<float>(lux) * colour;
}

bool have_same_estimate(const RenderSettings& a, const RenderSettings& b) {
  return a.sampling == b.sampling && a.reuse == b.reuse && a.indirect == b.indirect &&
         a.environment == b.environment && a.air == b.air && a.projection == b.projection;
}

bool is_half_rate(const RenderSettings& settings) {
  return settings.sampling.half_rate && !settings.sampling.layers &&
         traits_of(settings.sampling.estimator).samples;
}

std::string describe_half_rate(const AveragingSettings& averaging, std::uint32_t frames) {
  // Two frames at rest sample every pixel; a mean that moves may hold what was filled.
  return frames < 2 || averaging.window > 0
             ? "half rate: every second pixel filled from those beside it, biased"
             : "half rate: every pixel sampled in each second frame";
}

float extinction_of(const AirSettings& air) {
  constexpr float log_of_contrast = 3.912f;  // -ln 0.02
  return air.visibility_km > 0
             ? log_of_contrast / (1000 * std::max(air.visibility_km, min_visibility_km))
             : 0;
}

const char* name_projection(std::uint32_t projection) {
  switch (projection) {
    case PROJECTION_FISHEYE:
      return "fisheye";
    case PROJECTION_EQUIRECTANGULAR:
      return "equirectangular";
    default:
      return "perspective";
  }
}

std::uint32_t find_projection(const std::string& name) {
  for (const std::uint32_t projection :
       {PROJECTION_PERSPECTIVE, PROJECTION_FISHEYE, PROJECTION_EQUIRECTANGULAR})
    if (name == name_projection(projection)) return projection;
  throw UsageError("--projection",
                   "'" + name + "' is none of perspective, fisheye and equirectangular");
}

RenderSettings to_draft(RenderSettings settings) {
  settings.indirect.bounces = 0;
  settings.air.visibility_km = 0;
  settings.sampling.half_rate = false;
  settings.reuse.neighbours = 0;
  settings.display.denoise = false;
  settings.forced_features = 0;
  return settings;
}

std::uint32_t find_indirect(const RenderSettings& settings) {
  if (settings.indirect.bounces == 0) return INDIRECT_NONE;
  return settings.indirect.cache && traits_of(settings.sampling.estimator).samples ? INDIRECT_CACHE
                                                                                   : INDIRECT_PATHS;
}

std::string describe_indirect(const RenderSettings& settings, std::uint32_t lights) {
  const bool takes_every_light =
      settings.sampling.estimator == Estimator::reference && lights <= REFERENCE_CHUNK;
  switch (find_indirect(settings)) {
    case INDIRECT_PATHS:
      return takes_every_light ? "paths, unbiased, lit by every light"
                               : "paths, unbiased, lit by resampled lights";
    case INDIRECT_CACHE:
      return settings.environment.wetness > 0
                 ? "irradiance cache, smoothed over its cells, water films made rougher"
                 : "irradiance cache, smoothed over its cells";
    default:
      return "";
  }
}

RenderSettings to_published(RenderSettings settings) {
  settings.sampling.near_share = 0;
  settings.sampling.far_share = 0;
  settings.sampling.uniform_share = 1;
  settings.sampling.roulette_steps = 0;
  settings.reuse.history_falloff_m = 0;
  settings.reuse.disocclusion_boost = 0;
  settings.reuse.permute = false;
  return settings;
}

const std::vector<Feature>& optional_features() {
  static const std::vector<Feature> features{{CONSTANT_PROFILES, "lamp profiles"},
                                             {CONSTANT_RECTANGLES, "windows"},
                                             {CONSTANT_SCHEDULES, "schedules"},
                                             {CONSTANT_SKY, "sky"},
                                             {CONSTANT_GLOSS, "wet streets"},
                                             {CONSTANT_INDIRECT, "bounces"},
                                             {CONSTANT_AIR, "air"},
                                             {CONSTANT_TEXTURES, "textures"}};
  return features;
}

}  // namespace nightcity::render
