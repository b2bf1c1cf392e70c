// What the user may choose about the renderer, and the names those choices go by.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "shaders/interface.h"
#include "shaders/tonemap.glsl.h"

namespace nightcity {

enum class Estimator : std::uint32_t {
  reference = ESTIMATOR_REFERENCE,
  ris = ESTIMATOR_RIS,
  paper = ESTIMATOR_PAPER,
  basic = ESTIMATOR_BASIC,
  pairwise = ESTIMATOR_PAIRWISE,
  traced = ESTIMATOR_TRACED,
};

struct EstimatorName {
  Estimator estimator;
  const char* name;
  const char* description;
};

/// Every estimator, in the order of DESIGN's ladder.
const std::vector<EstimatorName>& estimator_names();
const char* name_of(Estimator estimator);
/// Throws UsageError naming the estimators there are.
Estimator estimator_from_name(const std::string& name);

constexpr std::uint32_t max_candidates = 1024;
constexpr std::uint32_t max_neighbours = 32;  // spatial.comp's array

struct RenderSettings {
  Estimator estimator = Estimator::traced;  // chosen by measurement: docs/accuracy.md
  std::uint32_t candidates = 32;            // a pixel and frame, 1 .. max_candidates
  std::uint32_t neighbours = 5;             // spatial reuse, 0 .. max_neighbours
  float neighbour_radius_px = 10;
  float history_cap =
      20;  // M of the history, in multiples of a frame's candidates; 0 = no temporal reuse
  float reach_m =
      1.5f;  // half of the history's M counts where it was gathered so far away; 0 = all
  std::uint32_t boost = 0;   // neighbours of a pixel without history, where more than `neighbours`
  bool permute = false;      // reuse the history in an order that changes from frame to frame
  float local_share = 0.5f;  // of candidates picked from the lights that are strong near the place
  float wide_share = 0.3f;   // of candidates picked from those of the quarter around it
  float uniform_share = 0.05f;  // of candidates picked uniformly over lights, the rest by flux
  float fleet_share = 0.3f;     // of all candidates picked from vehicles' lights, where any shine
  double time_s = 8 * 3600;     // since noon
  bool visibility_reuse =
      false;  // drop shadowed candidates before reuse: less noise, biased (basic, pairwise)
  bool accumulate = true;  // mean of frames; else every frame stands alone
  std::uint32_t window =
      0;  // mean of at most so many frames, carried along by motion; 0 = of all, while nothing moves
  bool denoise = false;  // filter the mean: for the eye, never for figures
  bool layers = false;   // keep what each kind of light gives apart
  float wetness = 0;     // of surfaces that face up, 0 .. 1
  bool jitter = true;    // sub-pixel offsets from frame to frame: anti-aliasing
  std::uint32_t seed = 0;
  glm::vec3 sky_cd_m2{
      0};  // luminance of rays that leave the scene; with a sky map, a factor for it
  glm::vec3 moon_direction{0, 1, 0};  // towards it, unit
  glm::vec3 moon_lux{0};              // on a surface that faces it; 0 = no moon
  float ev100 = 2;                    // of the displayed picture
  std::uint32_t tone = TONEMAP_FILMIC;
  // Passes compiled for features all the same that scene and settings do not need: bits 1 << CONSTANT_*, of
  // needless_features(). The picture is the same; what it costs is what leaving them out saves.
  std::uint32_t needless = 0;
};

struct Feature {
  std::uint32_t constant;  // CONSTANT_*
  const char* name;
};

/// What a picture can do without: lamps' profiles, windows, schedules, the sky, wet streets.
const std::vector<Feature>& needless_features();

}  // namespace nightcity
