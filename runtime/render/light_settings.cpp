// The settings of what shines and scatters besides lamps, and of how the picture is shown.
#include "runtime/render/setting_rows.h"

namespace nightcity::render::rows {
namespace {

using Indirect = IndirectSettings;

bool bounces(const Settings& s) {
  return s.indirect.bounces > 0;
}

bool uses_cache(const Settings& s) {
  return bounces(s) && s.indirect.cache && traits(s).samples;
}

// The sky is grey: its first channel stands for all three.
Setting::Value find_sky(Settings& s) {
  return &s.environment.sky_cd_m2.x;
}

void set_glow(Settings& s, SkyGlow glow) {
  s.environment.glow = glow;
  s.environment.sky_cd_m2 = glm::vec3(1);  // the factor of the map
}

bool is_foggy(const Settings& s) {
  return s.air.visibility_km > 0;
}

bool samples_air(const Settings& s) {
  return is_foggy(s) && samples(s);
}

}  // namespace

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
       .applies = is_foggy},
      {.name = "air-asymmetry",
       .group = Group::air,
       .min = -0.95,
       .max = 0.95,
       .help = "Mean cosine of the angle by which the air scatters light: 0 = evenly, 0.9 = mostly "
               "forwards",
       .value = at<air, &AirSettings::asymmetry>,
       .applies = is_foggy},
      {.name = "air-albedo",
       .group = Group::air,
       .help =
           "Share of the light that the air takes which it scatters: 1 for droplets, 0.6 to 0.9 "
           "for smoke",
       .value = at<air, &AirSettings::albedo>,
       .applies = is_foggy},
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

}  // namespace nightcity::render::rows
