#include "runtime/nightview/render_options.h"

#include <spdlog/spdlog.h>

#include <cmath>

#include "formats/error.h"
#include "runtime/measure/exr.h"
#include "runtime/nightview/device_options.h"
#include "runtime/nightview/number_check.h"
#include "runtime/render/parse.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/scene_file.h"

namespace nightcity::nightview {
namespace {

std::string join_names(const render::Setting& setting) {
  std::string names = render::option_of(setting);
  for (const char* alias : setting.aliases) names += std::string(",--") + alias;
  return names;
}

}  // namespace

void declare_setting(CLI::App& command, const render::Setting& setting,
                     render::RenderSettings& settings) {
  const std::string names = join_names(setting), help = render::describe(setting);
  const render::Setting::Value value = setting.value(settings);
  if (const auto flag = std::get_if<bool*>(&value)) {
    const std::string off = std::string(",!--no-") + setting.name;
    command.add_flag(**flag ? names + off : names, **flag, help);
  } else if (const auto count = std::get_if<std::uint32_t*>(&value)) {
    command.add_option(names, **count, help)
        ->capture_default_str()
        ->check(CLI::Range(std::uint32_t(setting.min), std::uint32_t(setting.max)));
  } else if (const auto number = std::get_if<float*>(&value)) {
    command.add_option(names, **number, help)
        ->capture_default_str()
        ->check(number_from(setting.min, setting.max));
  } else {
    const auto set = [estimator = std::get<render::Estimator*>(value)](const std::string& name) {
      *estimator = render::find_estimator(name);
    };
    command.add_option_function<std::string>(names, set, help)
        ->default_str(render::text_of(setting, settings));
  }
}

void declare_scene(CLI::App& command, std::string& scene) {
  command
      .add_option("scene", scene,
                  "SCENE.glb, or the folder that holds it; SCENE.lights beside it is read too")
      ->required();
}

void declare_size(CLI::App& command, std::string& size) {
  command.add_option("--size", size, "Picture size in pixels, WIDTHxHEIGHT")->capture_default_str();
}

scene::RenderScene load_and_report(const std::string& scene) {
  scene::RenderScene loaded = scene::load_render_scene(scene::find_scene_file(scene));
  for (const std::string& sentence : scene::describe_left_out(loaded))
    spdlog::warn("{}: {}", scene, sentence);
  return loaded;
}

void RenderOptions::declare(CLI::App& command) {
  std::string presets;
  for (const std::string& name : scene::camera_presets())
    presets += (presets.empty() ? "" : ", ") + name;
  declare_scene(command, scene);
  declare_size(command, size);
  for (const render::Setting& setting : render::list_settings())
    declare_setting(command, setting, settings);
  command
      .add_option("--time", time,
                  "Time of the night, HH:MM or HH:MM:SS (seconds may have a fraction)")
      ->capture_default_str();
  declare_device(command, device);
  command.add_option("--camera", camera, "Camera file (JSON) or preset: " + presets)
      ->capture_default_str();
  command.add_option("--sky-map", sky_map,
                     "EXR of the sky's luminance by direction in cd/m2, latitude-longitude with "
                     "north in the middle; --sky becomes a factor for it");
  command
      .add_option("--lights", lights,
                  "Kinds of light that shine when it is their time: all, none, or a list of "
                  "lamp, window, headlamp, tail_lamp and other")
      ->capture_default_str();
  command.add_option("--moon", moon,
                     "Moon: AZIMUTH,ELEVATION in degrees (azimuth from north over east), or with "
                     ",LUX (full moon: 0.25)");
}

void RenderOptions::resolve() {
  render::EnvironmentSettings& environment = settings.environment;
  environment.sky_cd_m2 = glm::vec3(environment.sky_cd_m2.x);
  if (!sky_map.empty() && environment.sky_cd_m2 == glm::vec3(0))
    environment.sky_cd_m2 = glm::vec3(1);
  if (!moon.empty()) {
    const render::MoonPosition place = render::parse_moon(moon);
    render::set_moon(environment, place.azimuth_deg, place.elevation_deg, place.lux);
  }
  environment.lights = scene::parse_families(lights);
  settings.time_s = render::parse_time(time);
  const render::PictureSize parsed = render::parse_size(size);
  width = parsed.width;
  height = parsed.height;
}

scene::RenderScene RenderOptions::load(const std::string& other) const {
  scene::RenderScene loaded = load_and_report(other);
  if (!sky_map.empty()) {
    const measure::Image image = measure::read_exr(sky_map);
    loaded.sky_map = {image.width, image.height, image.rgb};
    for (float& value : loaded.sky_map.rgb)
      if (!(std::isfinite(value) && value >= 0))
        throw Error(sky_map, "holds a luminance that is negative or not finite");
  }
  return loaded;
}

}  // namespace nightcity::nightview
