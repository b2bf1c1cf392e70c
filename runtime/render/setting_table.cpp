#include "runtime/render/setting_table.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <type_traits>

#include "formats/error.h"
#include "runtime/render/parse.h"

namespace nightcity::render {
namespace {

using Settings = RenderSettings;

const EstimatorTraits& traits(const Settings& s) {
  return traits_of(s.sampling.estimator);
}

bool samples(const Settings& s) {
  return traits(s).samples;
}

bool may_have_half_rate(const Settings& s) {
  return traits(s).samples && !s.sampling.layers;
}

bool chooses_shares(const Settings& s) {
  return traits(s).samples && !traits(s).as_published;
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

bool bounces(const Settings& s) {
  return s.indirect.bounces > 0;
}

bool uses_cache(const Settings& s) {
  return bounces(s) && s.indirect.cache && traits(s).samples;
}

template <auto group, auto member>
Setting::Value at(Settings& s) {
  return &(s.*group.*member);
}

constexpr auto sampling = &Settings::sampling;
constexpr auto reuse = &Settings::reuse;
constexpr auto indirect = &Settings::indirect;
constexpr auto environment = &Settings::environment;
constexpr auto air = &Settings::air;
constexpr auto display = &Settings::display;

using Sampling = SamplingSettings;
using Reuse = ReuseSettings;
using Indirect = IndirectSettings;
using Group = SettingGroup;

constexpr double max_seed = std::numeric_limits<std::uint32_t>::max();

// The sky is grey: its first channel stands for all three.
Setting::Value find_sky(Settings& s) {
  return &s.environment.sky_cd_m2.x;
}

void set_glow(Settings& s, SkyGlow glow) {
  s.environment.glow = glow;
  s.environment.sky_cd_m2 = glm::vec3(1);  // the factor of the map
}

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
       .help = "Share of all candidates sampled from vehicles' lights, where any shine",
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

std::vector<Setting> make_indirect_settings() {
  return {
      {.name = "bounces",
       .group = Group::indirect,
       .max = MAX_BOUNCES,
       .help =
           "How often light may bounce off surfaces before it reaches the one that is seen; 0 = "
           "direct light alone",
       .value = at<indirect, &Indirect::bounces>,
       .is_swept = true,
       .slider = SettingSlider{"bounces", 8, "%u"}},
      {.name = "cache",
       .group = Group::indirect,
       .help =
           "Keep the light that bounced in cells of space: smoothed, and so slightly wrong near "
           "edges, and in rain. --no-cache follows one path a pixel and frame: unbiased, noisy",
       .value = at<indirect, &Indirect::cache>,
       .applies = bounces,
       .is_swept = true},
      {.name = "cache-cell",
       .group = Group::indirect,
       .unit = "pixels",
       .min = 1,
       .max = 64,
       .help = "Side of the cache's cells, to the power of two above",
       .value = at<indirect, &Indirect::cell_px>,
       .applies = uses_cache,
       .is_swept = true},
      {.name = "cache-paths",
       .group = Group::indirect,
       .min = 1,
       .max = 64,
       .help =
           "Paths per cell and frame; a new cell gets four times as many, a settled one a quarter",
       .value = at<indirect, &Indirect::paths>,
       .applies = uses_cache,
       .is_swept = true},
  };
}

bool has_air(const Settings& s) {
  return s.air.visibility_km > 0;
}

bool samples_air(const Settings& s) {
  return has_air(s) && samples(s);
}

std::vector<Setting> make_air_settings() {
  return {
      {.name = "visibility",
       .group = Group::air,
       .unit = "km",
       .max = 10000,
       .help =
           "How far one sees by day in this air, at the scene's lowest point (fog: below 1, haze: "
           "below 10); 0 = clear air, which neither weakens light nor glows, less than 0.001 "
           "counts as 0.001",
       .value = at<air, &AirSettings::visibility_km>,
       .slider = SettingSlider{"visibility", 50, "%.2f km", true}},
      {.name = "air-height",
       .group = Group::air,
       .unit = "m",
       .max = 100000,
       .help = "Height over which the air gets e = 2.7 times as clear; 0 = the same at all heights",
       .value = at<air, &AirSettings::height_m>,
       .applies = has_air},
      {.name = "air-asymmetry",
       .group = Group::air,
       .min = -0.95,
       .max = 0.95,
       .help = "Mean cosine of the angle by which the air scatters light: 0 = evenly, 0.9 = mostly "
               "forwards",
       .value = at<air, &AirSettings::asymmetry>,
       .applies = has_air},
      {.name = "air-albedo",
       .group = Group::air,
       .help =
           "Share of the light that the air takes which it scatters: 1 for droplets, 0.6 to 0.9 "
           "for smoke",
       .value = at<air, &AirSettings::albedo>,
       .applies = has_air},
      {.name = "air-candidates",
       .group = Group::air,
       .min = 1,
       .max = max_candidates,
       .help = "Candidates of each sample of scattered light",
       .value = at<air, &AirSettings::candidates>,
       .applies = samples_air,
       .is_swept = true},
      {.name = "air-block",
       .group = Group::air,
       .min = 1,
       .max = max_air_block,
       .help =
           "Side of the blocks of pixels of which each frame samples the scattered light of one: "
           "2 costs a quarter and is twice as noisy",
       .value = at<air, &AirSettings::block>,
       .applies = samples_air,
       .is_swept = true},
  };
}

std::vector<Setting> make_other_settings() {
  return {
      {.name = "sky",
       .group = Group::environment,
       .unit = "cd/m2",
       .max = 1e6,
       .help =
           "Luminance of the sky, which is seen and lights the scene: one number for all "
           "directions (over a city 0.002 to 0.02); auto: the scene's own light in clear air, "
           "after Garstang; overcast: the same under clouds. Where none is given, it is auto in "
           "pictures that are looked at (the window, PNGs and films without EXRs), else 0",
       .value = find_sky,
       .words = {{"auto", [](Settings& s) { set_glow(s, SkyGlow::clear); },
                  [](const Settings& s) { return s.environment.glow == SkyGlow::clear; }},
                 {"overcast", [](Settings& s) { set_glow(s, SkyGlow::overcast); },
                  [](const Settings& s) { return s.environment.glow == SkyGlow::overcast; }}},
       .leave_words = [](Settings& s) { s.environment.glow = SkyGlow::none; }},
      {.name = "city-radius",
       .group = Group::environment,
       .unit = "km",
       .max = 200,
       .help =
           "With --sky auto or overcast: how far from the scene's middle the city is taken to go "
           "on, shining as the scene does; 0 = the scene is the whole city",
       .value = at<environment, &EnvironmentSettings::city_radius_km>,
       .applies = [](const Settings& s) { return s.environment.glow != SkyGlow::none; }},
      {.name = "wet",
       .group = Group::environment,
       .help = "How wet the streets are, 0 to 1",
       .value = at<environment, &EnvironmentSettings::wetness>,
       .slider = SettingSlider{"wet streets", 1, "%.2f"}},
      {.name = "traffic",
       .group = Group::environment,
       .max = 10,
       .help =
           "Vehicles on the road, as a share of those that the time of the night has, as far as "
           "the scene has trips; 0 = none",
       .value = at<environment, &EnvironmentSettings::traffic>,
       .slider = SettingSlider{"traffic", 2, "%.2f"}},
      {.name = "denoise",
       .group = Group::display,
       .help = "Filter the picture: for viewing, never for measurements",
       .value = at<display, &DisplaySettings::denoise>},
      {.name = "glare",
       .group = Group::display,
       .unit = "years",
       .max = max_glare_age,
       .help =
           "Show the light that an eye of this age scatters around lamps (CIE 135/1, 1999); 0 = "
           "none. In what is looked at, never in measurements and EXRs",
       .value = at<display, &DisplaySettings::glare_age>,
       .slider = SettingSlider{"glare", 80, "eye of %.0f years"}},
      {.name = "white-balance",
       .group = Group::display,
       .unit = "K",
       .max = 15000,
       .help = "Show the light of a black body of this temperature as grey, as a camera does; 0 = "
               "leave colours as they are. In what is looked at",
       .value = at<display, &DisplaySettings::white_balance_k>,
       .slider = SettingSlider{"white", 10000, "%.0f K"}},
      {.name = "adapt-white",
       .group = Group::display,
       .help = "Adapt the white to the scene as far as an eye does (CIECAM02), where no "
               "--white-balance is given. In what is looked at",
       .value = at<display, &DisplaySettings::adapt_white>,
       .applies = [](const Settings& s) { return s.display.white_balance_k == 0; }},
      {.name = "mesopic",
       .group = Group::display,
       .help = "Show dim places as rods see them: with less colour, and bluish (CIE 191:2010). In "
               "what is looked at",
       .value = at<display, &DisplaySettings::mesopic>},
  };
}

// Columns of sweeps keep their order: what is new comes last.
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
  };
}

}  // namespace

const std::vector<Setting>& list_settings() {
  static const std::vector<Setting> settings = [] {
    std::vector<Setting> all;
    // In this order they are the columns of sweep.csv.
    for (const auto& part : {make_first_settings(), make_reuse_settings(), make_sampling_settings(),
                             make_indirect_settings(), make_other_settings(), make_air_settings(),
                             make_last_settings()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return settings;
}

const Setting* find_setting(const std::string& name) {
  for (const Setting& setting : list_settings())
    if (name == setting.name || std::any_of(setting.aliases.begin(), setting.aliases.end(),
                                            [&](const char* alias) { return name == alias; }))
      return &setting;
  return nullptr;
}

std::string describe(const Setting& setting) {
  const std::string unit = setting.unit;
  return setting.help + (unit.empty() ? "" : " (" + unit + ")");
}

std::string column_of(const Setting& setting) {
  return setting.column ? setting.column : setting.name;
}

std::string option_of(const Setting& setting) {
  return std::string("--") + setting.name;
}

void set_from_text(const Setting& setting, RenderSettings& settings, const std::string& word) {
  const std::string option = option_of(setting);
  for (const SettingWord& known : setting.words)
    if (word == known.word) return known.set(settings);
  const Setting::Value value = setting.value(settings);
  if (const auto flag = std::get_if<bool*>(&value)) {
    **flag = parse_yes_or_no(option, word);
  } else if (const auto count = std::get_if<std::uint32_t*>(&value)) {
    **count = static_cast<std::uint32_t>(
        parse_count(option, word, std::size_t(setting.min), std::size_t(setting.max)));
  } else if (const auto number = std::get_if<float*>(&value)) {
    const auto parsed = static_cast<float>(parse_number(option, word, setting.min, setting.max));
    setting.leave_words(settings);
    **number = parsed;
  } else {
    *std::get<Estimator*>(value) = find_estimator(word);
  }
}

std::string text_of(const Setting& setting, RenderSettings settings) {
  for (const SettingWord& known : setting.words)
    if (known.is_set(settings)) return known.word;
  const auto to_text = [](auto* value) -> std::string {
    using Value = std::remove_pointer_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, bool>) {
      return *value ? "yes" : "no";
    } else if constexpr (std::is_same_v<Value, Estimator>) {
      return name_of(*value);
    } else {
      char text[32];
      return {text, std::to_chars(text, text + sizeof text, *value).ptr};
    }
  };
  return std::visit(to_text, setting.value(settings));
}

std::string default_list(const Setting& setting) {
  return setting.sweep_values.empty() ? text_of(setting, {}) : setting.sweep_values;
}

void check_settings(const RenderSettings& settings) {
  RenderSettings copy = settings;
  for (const Setting& setting : list_settings()) {
    const auto is_in_range = [&](auto* value) {
      if constexpr (std::is_same_v<decltype(value), Estimator*>)
        return true;
      else  // written so that NaN fails
        return double(*value) >= setting.min && double(*value) <= setting.max;
    };
    if (!std::visit(is_in_range, setting.value(copy)))
      throw UsageError(option_of(setting), "must be from " + std::to_string(setting.min) + " to " +
                                               std::to_string(setting.max));
  }
  // A light that is never sampled is missing from the picture, and nothing in the picture shows it.
  if (!(settings.sampling.near_share + settings.sampling.far_share <= 0.999f))
    throw UsageError("--near-share",
                     "and --far-share may be 0.999 together: lights that no grid cell lists need a "
                     "share too");
}

}  // namespace nightcity::render
