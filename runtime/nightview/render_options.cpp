#include "runtime/nightview/render_options.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <glm/trigonometric.hpp>

#include "formats/error.h"
#include "runtime/measure/exr.h"
#include "runtime/measure/image.h"
#include "runtime/nightview/device_options.h"
#include "runtime/scene/camera.h"

namespace nightcity {
namespace {

void parse_size(const std::string& text, std::uint32_t& width, std::uint32_t& height) {
  const char* end = text.data() + text.size();
  const auto [x, error_w] = std::from_chars(text.data(), end, width);
  bool good = error_w == std::errc() && x != end && *x == 'x';
  if (good) {
    const auto [rest, error_h] = std::from_chars(x + 1, end, height);
    good = error_h == std::errc() && rest == end;
  }
  if (!good || width < 1 || height < 1 || width > max_image_side || height > max_image_side)
    throw UsageError("--size", "expected WIDTHxHEIGHT with 1 to " + std::to_string(max_image_side) +
                                   " pixels a side, not '" + text + "'");
}

// Azimuth and elevation in degrees, lux on a facing surface.
std::array<double, 3> parse_moon(const std::string& text) {
  std::array<double, 3> value{0, 0, 0.25};
  int read = 0, more = 0;
  bool good = std::sscanf(text.c_str(), "%lf,%lf%n", &value[0], &value[1], &read) == 2;
  if (good && std::size_t(read) < text.size()) {
    good = std::sscanf(text.c_str() + read, ",%lf%n", &value[2], &more) == 1;
    read += more;
  }
  if (!good || std::size_t(read) != text.size() || !(value[0] >= -360 && value[0] <= 360) ||
      !(value[1] > 0 && value[1] <= 90) || !(value[2] > 0 && value[2] <= 1000))
    throw UsageError(
        "--moon",
        "expected AZIMUTH,ELEVATION or AZIMUTH,ELEVATION,LUX with an elevation above 0, not '" +
            text + "'");
  return value;
}

std::string listed_estimators() {
  std::string text = "How light is estimated:";
  for (const EstimatorName& entry : estimator_names())
    text += std::string("\n  ") + entry.name + ": " + entry.description;
  return text;
}

}  // namespace

double parse_time(const std::string& text) {
  unsigned hours = 0, minutes = 0;
  double seconds = 0;
  int read = 0;
  bool good = std::sscanf(text.c_str(), "%2u:%2u%n", &hours, &minutes, &read) == 2;
  if (good && std::size_t(read) < text.size()) {
    int more = 0;
    good = std::sscanf(text.c_str() + read, ":%lf%n", &seconds, &more) == 1;
    read += more;
  }
  if (!good || std::size_t(read) != text.size() || hours >= 24 || minutes >= 60 ||
      !(seconds >= 0 && seconds < 60))
    throw UsageError("--time", "expected HH:MM or HH:MM:SS, not '" + text + "'");
  return ((hours + 12) % 24) * 3600.0 + minutes * 60.0 + seconds;
}

void RenderOptions::declare(CLI::App& command) {
  std::string presets;
  for (const std::string& name : camera_presets()) presets += (presets.empty() ? "" : ", ") + name;
  command.add_option("scene", scene, "SCENE.glb; SCENE.lights beside it is read too")->required();
  command.add_option("--size", size, "Picture size in pixels, WIDTHxHEIGHT")->capture_default_str();
  command.add_option("--estimator", estimator, listed_estimators())->capture_default_str();
  command.add_option("--candidates", settings.candidates, "Light candidates a pixel and frame")
      ->capture_default_str()
      ->check(CLI::Range(1u, max_candidates));
  command
      .add_option("--neighbours", settings.neighbours,
                  "Pixels whose reservoirs are reused, a pixel and frame")
      ->capture_default_str()
      ->check(CLI::Range(0u, max_neighbours));
  command
      .add_option("--radius", settings.neighbour_radius_px,
                  "How far neighbours are looked for, pixels")
      ->capture_default_str()
      ->check(CLI::Range(1.0f, 1000.0f));
  command
      .add_option("--history", settings.history_cap,
                  "Weight of the frames before, in frames; 0 = no temporal reuse")
      ->capture_default_str()
      ->check(CLI::Range(0.0f, 1000.0f));
  command
      .add_option(
          "--reach", settings.reach_m,
          "Distance between a place and where its history was gathered at which half of it counts, "
          "m; 0 = all")
      ->capture_default_str()
      ->check(CLI::Range(0.0f, 100000.0f));
  command
      .add_option("--boost", settings.boost,
                  "Pixels reused by a pixel that has no history (just come into view), where more "
                  "than --neighbours")
      ->capture_default_str()
      ->check(CLI::Range(0u, max_neighbours));
  command.add_flag(
      "--permute", settings.permute,
      "Reuse the history in an order that changes from frame to frame: less alike noise");
  command
      .add_option("--local-share", settings.local_share,
                  "Share of candidates picked from the lights that are strong near the place")
      ->capture_default_str()
      ->check(CLI::Range(0.0f, 1.0f));
  command
      .add_option("--wide-share", settings.wide_share,
                  "Share of candidates picked from the lights of the quarter around the place")
      ->capture_default_str()
      ->check(CLI::Range(0.0f, 1.0f));
  command
      .add_option("--uniform-share", settings.uniform_share,
                  "Share of candidates picked uniformly; what is left is picked by flux")
      ->capture_default_str()
      ->check(CLI::Range(0.0f, 1.0f));
  command
      .add_option("--fleet-share", settings.fleet_share,
                  "Share of all candidates picked from vehicles' lights, where any shine")
      ->capture_default_str()
      ->check(CLI::Range(0.0f, 1.0f));
  command
      .add_option("--time", time,
                  "Time of the night, HH:MM or HH:MM:SS (seconds may have a fraction)")
      ->capture_default_str();
  command.add_flag("--visibility-reuse", settings.visibility_reuse,
                   "basic, pairwise: drop shadowed candidates before reuse (less noise, biased)");
  command.add_flag("--jitter,!--no-jitter", settings.jitter,
                   "Sub-pixel offsets from frame to frame (on by default)");
  command.add_option("--seed", settings.seed, "Of all random numbers")->capture_default_str();
  declare_device(command, device);
  command.add_option("--camera", camera, "Camera file (JSON) or preset: " + presets)
      ->capture_default_str();
  command
      .add_option(
          "--sky", settings.sky_cd_m2[0],
          "Uniform luminance of the sky, cd/m2: seen, and lighting the scene (a city's skyglow: "
          "0.002 to 0.02)")
      ->check(CLI::Range(0.0f, 1e6f))
      ->default_str("0");
  command.add_option(
      "--sky-map", sky_map,
      "EXR of the sky's luminance by direction in cd/m2, latitude-longitude, north in its "
      "middle; --sky is then a factor");
  command.add_option("--moon", moon,
                     "Moon: AZIMUTH,ELEVATION in degrees (azimuth from north over east), or with "
                     ",LUX (full moon: 0.25)");
  command.add_option("--wet", settings.wetness, "How wet the streets are, 0 to 1")
      ->capture_default_str()
      ->check(CLI::Range(0.0f, 1.0f));
  command.add_flag("--denoise", settings.denoise,
                   "Filter the picture: for the eye, not for figures");
}

void RenderOptions::resolve() {
  settings.estimator = estimator_from_name(estimator);
  settings.sky_cd_m2 = glm::vec3(settings.sky_cd_m2[0]);
  settings.time_s = parse_time(time);
  if (!moon.empty()) {
    const auto [azimuth, elevation, lux] = parse_moon(moon);
    const double a = glm::radians(azimuth), e = glm::radians(elevation);
    settings.moon_direction =
        glm::vec3(std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e));
    // Sunlight off its surface, of about 4,100 K; a colour of luminance 1.
    settings.moon_lux = static_cast<float>(lux) * glm::vec3(1.16f, 0.97f, 0.80f);
  }
  if (!sky_map.empty() && settings.sky_cd_m2 == glm::vec3(0)) settings.sky_cd_m2 = glm::vec3(1);
  parse_size(size, width, height);
}

RenderScene RenderOptions::load() const {
  RenderScene loaded = load_render_scene(scene);
  if (!sky_map.empty()) {
    const Image image = read_exr(sky_map);
    loaded.sky_map = {image.width, image.height, image.rgb};
    for (float& value : loaded.sky_map.rgb)
      if (!(std::isfinite(value) && value >= 0))
        throw Error(sky_map, "holds a luminance that is negative or not finite");
  }
  return loaded;
}

}  // namespace nightcity
