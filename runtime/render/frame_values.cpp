#include "runtime/render/frame_values.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/render/setting_table.h"

namespace nightcity::render {
namespace {

// The shortest falloff of the history: 1 / falloff^2 of shorter ones would overflow.
constexpr float min_history_falloff_m = 0.001f;

// The thinnest layer of air, for the same reason.
constexpr float min_air_height_m = 0.001f;

// Sub-pixel positions: the R2 sequence (Roberts 2018), starting at the pixel's centre.
float radical(double step, std::uint32_t frame) {
  const double x = 0.5 + step * double(frame);
  return static_cast<float>(std::min(x - std::floor(x), 0.99999994));
}

}  // namespace

std::uint32_t pairings_of(const ReuseSettings& reuse) {
  return reuse.max_history > 0 ? std::max(reuse.neighbours, reuse.disocclusion_boost)
                               : reuse.neighbours;
}

glm::vec2 find_sub_pixel(std::uint32_t number) {
  return {radical(0.7548776662466927, number), radical(0.5698402909980532, number)};
}

void level_camera(gpu::Camera& camera) {
  glm::vec3 ahead = camera.forward;
  if (std::abs(ahead.y) > 0.999f) ahead = camera.up;
  camera.forward = glm::normalize(glm::vec3(ahead.x, 0, ahead.z));
  camera.up = {0, 1, 0};
  camera.right = glm::cross(camera.forward, camera.up);
}

gpu::Air make_air(const AirSettings& settings, float ground_m) {
  gpu::Air air{};
  air.extinction = extinction_of(settings);
  air.falloff = settings.height_m > 0 ? 1 / std::max(settings.height_m, min_air_height_m) : 0;
  air.level = ground_m;
  air.asymmetry = settings.asymmetry;
  air.albedo = settings.albedo;
  air.candidates = settings.candidates;
  air.block = settings.block;
  return air;
}

void fill_sampling(gpu::Frame& frame, const RenderSettings& chosen, float step_cd_m2) {
  const bool as_published = traits_of(chosen.sampling.estimator).as_published;
  const RenderSettings settings = as_published ? to_published(chosen) : chosen;
  const SamplingSettings& sampling = settings.sampling;
  frame.seed = sampling.seed;
  frame.candidates = sampling.candidates;
  frame.near_share = sampling.near_share;
  frame.far_share = std::min(sampling.far_share, 1.0f - frame.near_share);
  frame.uniform_share =
      std::clamp(sampling.uniform_share, 0.0f, 1.0f - frame.near_share - frame.far_share);
  // As published, candidates are uniform over all lights: vehicles' lights get the share that they
  // are.
  const double moving = double(frame.scene.light_count - frame.scene.static_lights);
  frame.vehicle_share = as_published ? float(moving / std::max(1.0, moving + frame.scene.lit_count))
                                     : sampling.vehicle_share;

  frame.faint_luminance = sampling.roulette_steps * step_cd_m2;
  const ReuseSettings& reuse = settings.reuse;
  frame.neighbours = reuse.neighbours;
  frame.neighbour_radius = reuse.neighbour_radius_px;
  frame.max_history = reuse.max_history;
  const float falloff_m = std::max(reuse.history_falloff_m, min_history_falloff_m);
  frame.history_falloff = reuse.history_falloff_m <= 0 ? 0 : 1 / (falloff_m * falloff_m);
  frame.disocclusion_boost = reuse.disocclusion_boost;
  frame.pairings = pairings_of(reuse);
  // With the frame's number, so that two frames in a row sample all pixels.
  frame.half_rate = is_half_rate(settings) ? 1 + frame.frame % 2 : 0;
  frame.pair_block = std::bit_ceil(static_cast<std::uint32_t>(reuse.neighbour_radius_px) + 1);
  // Fibonacci hashing: consecutive frames get distant corners.
  frame.permutation = reuse.permute ? (frame.frame * 2654435769u) >> 28 : NO_PERMUTATION;
}

}  // namespace nightcity::render
