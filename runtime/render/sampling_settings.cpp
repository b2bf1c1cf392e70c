// The settings of the estimator: how many samples, from where, and what is reused.
#include <limits>
#include <string>

#include "runtime/render/setting_rows.h"

namespace nightcity::render::rows {
namespace {

using Sampling = SamplingSettings;
using Reuse = ReuseSettings;

constexpr double max_seed = std::numeric_limits<std::uint32_t>::max();

bool may_have_half_rate(const Settings& s) {
  return traits(s).samples && !s.sampling.layers;
}

bool chooses_shares(const Settings& s) {
  return traits(s).samples && !traits(s).as_published;
}

// A reservoir that is not reused needs one ray at most.
bool may_play_roulette(const Settings& s) {
  return traits(s).reuses && !traits(s).as_published;
}

bool reuses(const Settings& s) {
  return traits(s).reuses;
}

bool reuses_neighbours(const Settings& s) {
  return traits(s).reuses && s.reuse.neighbours > 0;
}

bool tunes_history(const Settings& s) {
  return traits(s).reuses && !traits(s).as_published && s.reuse.max_history > 0;
}

bool tunes_history_and_neighbours(const Settings& s) {
  return tunes_history(s) && s.reuse.neighbours > 0;
}

bool reuses_unshadowed(const Settings& s) {
  return traits(s).reuses && !traits(s).as_published && !traits(s).shadowed_target;
}

std::string describe_estimators() {
  std::string text = "How light is estimated:";
  for (const EstimatorTraits& estimator : list_estimators())
    text += std::string("\n  ") + estimator.name + ": " + estimator.description;
  return text;
}

}  // namespace

std::vector<Setting> make_first_settings() {
  return {
      {.name = "estimator",
       .group = Group::sampling,
       .help = describe_estimators(),
       .value = at<sampling, &Sampling::estimator>,
       .is_swept = true,
       .sweep_values = "ris,paper,basic,pairwise,traced"},
      {.name = "candidates",
       .group = Group::sampling,
       .min = 1,
       .max = max_candidates,
       .help = "Light candidates per pixel and frame",
       .value = at<sampling, &Sampling::candidates>,
       .applies = samples,
       .is_swept = true,
       .sweep_values = "4,16,32",
       .slider = SettingSlider{"candidates", 128, "%u", true}},
  };
}

std::vector<Setting> make_reuse_settings() {
  return {
      {.name = "neighbours",
       .group = Group::reuse,
       .max = max_neighbours,
       .help = "Pixels whose reservoirs are reused by a pixel in a frame",
       .value = at<reuse, &Reuse::neighbours>,
       .applies = reuses,
       .is_swept = true,
       .sweep_values = "1,4",
       .slider = SettingSlider{"neighbours", max_neighbours, "%u"}},
      {.name = "radius",
       .group = Group::reuse,
       .unit = "pixels",
       .min = 1,
       .max = 1000,
       .help = "Distance within which reused pixels lie",
       .value = at<reuse, &Reuse::neighbour_radius_px>,
       .applies = reuses_neighbours,
       .is_swept = true},
      {.name = "max-history",
       .aliases = {"history"},
       .column = "history",
       .group = Group::reuse,
       .unit = "frames",
       .max = 1000,
       .help = "Greatest weight of earlier frames; 0 turns temporal reuse off",
       .value = at<reuse, &Reuse::max_history>,
       .applies = reuses,
       .is_swept = true,
       .slider = SettingSlider{"history", 40, "%.0f frames"}},
      {.name = "history-falloff",
       .aliases = {"reach"},
       .column = "reach",
       .group = Group::reuse,
       .unit = "m",
       .max = 100000,
       .help = "Distance between a surface point and where its history was gathered at which half "
               "of the "
               "history counts; 0 = all counts at any distance, less than 0.001 counts as 0.001",
       .value = at<reuse, &Reuse::history_falloff_m>,
       .applies = tunes_history,
       .is_swept = true},
      {.name = "disocclusion-boost",
       .aliases = {"boost"},
       .column = "boost",
       .group = Group::reuse,
       .max = max_neighbours,
       .help = "Pixels reused by a pixel without history (just come into view), where that is more "
               "than "
               "--neighbours",
       .value = at<reuse, &Reuse::disocclusion_boost>,
       .applies = tunes_history_and_neighbours,
       .is_swept = true},
      {.name = "permute",
       .group = Group::reuse,
       .help =
           "Reuse the history in an order that changes from frame to frame: less correlated noise",
       .value = at<reuse, &Reuse::permute>,
       .applies = tunes_history,
       .is_swept = true},
  };
}

std::vector<Setting> make_sampling_settings() {
  return {
      {.name = "near-share",
       .aliases = {"local-share"},
       .column = "local-share",
       .group = Group::sampling,
       .help =
           "Share of the candidates sampled from the lights that are strong near the surface point",
       .value = at<sampling, &Sampling::near_share>,
       .applies = chooses_shares,
       .is_swept = true},
      {.name = "far-share",
       .aliases = {"wide-share"},
       .column = "wide-share",
       .group = Group::sampling,
       .help = "Share of the candidates sampled from the lights of the neighbourhood",
       .value = at<sampling, &Sampling::far_share>,
       .applies = chooses_shares,
       .is_swept = true},
      {.name = "uniform-share",
       .group = Group::sampling,
       .help = "Share of the candidates sampled uniformly; the rest is sampled by flux",
       .value = at<sampling, &Sampling::uniform_share>,
       .applies = chooses_shares,
       .is_swept = true},
      {.name = "vehicle-share",
       .aliases = {"fleet-share"},
       .column = "fleet-share",
       .group = Group::sampling,
       .help = "Share of all candidates sampled from vehicles' lights, where any shine; down to a "
               "fifth of it where static lights are stronger",
       .value = at<sampling, &Sampling::vehicle_share>,
       .applies = chooses_shares,
       .is_swept = true},
      {.name = "visibility-reuse",
       .group = Group::reuse,
       .help = "Drop shadowed candidates before reuse (basic, pairwise): less noise, biased",
       .value = at<reuse, &Reuse::visibility_reuse>,
       .applies = reuses_unshadowed,
       .is_swept = true},
      {.name = "jitter",
       .group = Group::sampling,
       .help = "Offset the rays within their pixel from frame to frame (on by default)",
       .value = at<sampling, &Sampling::jitter>},
      {.name = "seed",
       .group = Group::sampling,
       .max = max_seed,
       .help = "Seed of all random numbers",
       .value = at<sampling, &Sampling::seed>},
  };
}

std::vector<Setting> make_last_settings() {
  return {
      {.name = "resolution-scale",
       .group = Group::sampling,
       .min = 0.1,
       .max = 1,
       .help = "Share of the picture's sides that is rendered; the picture is then upscaled, "
               "bilinearly",
       .value = at<sampling, &Sampling::resolution_scale>,
       .is_swept = true},
      {.name = "half-rate",
       .group = Group::sampling,
       .help = "Sample every second pixel in each frame, the others in the next, and fill those "
               "from like surfaces beside them. Biased in single frames and while anything moves: "
               "smoothed by one pixel, in one frame of the town's street by -0.04 % +- 0.03 % of "
               "its light; unbiased at rest. Pictures say so",
       .value = at<sampling, &Sampling::half_rate>,
       .applies = may_have_half_rate,
       .is_swept = true},
      {.name = "roulette",
       .group = Group::sampling,
       .unit = "8-bit steps",
       .max = 1000,
       .help = "Samples that show less than this at the metered exposure are dropped or weighed up "
               "by chance (Russian roulette): fewer rays for what is nearly black, unbiased; 0 = "
               "none are. Not in the first frame, which the exposure is metered from",
       .value = at<sampling, &Sampling::roulette_steps>,
       .applies = may_play_roulette,
       .is_swept = true},
  };
}

}  // namespace nightcity::render::rows
