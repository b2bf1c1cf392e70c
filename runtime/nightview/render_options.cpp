#include "runtime/nightview/render_options.h"

#include <spdlog/spdlog.h>

#include <cmath>

#include "formats/cancel.h"
#include "formats/error.h"
#include "formats/light_edits.h"
#include "formats/program/number_check.h"
#include "runtime/measure/exr.h"
#include "runtime/nightview/device_options.h"
#include "runtime/render/parse.h"
#include "runtime/render/presets.h"
#include "runtime/render/settings_file.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/scene_file.h"
#include "runtime/scene/scene_traits.h"
#include "runtime/scene/skyglow.h"

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
  if (!setting.words.empty()) {
    const auto set = [&setting, &settings](const std::string& word) {
      render::set_from_text(setting, settings, word);
    };
    command.add_option_function<std::string>(names, set, help)
        ->default_str(render::text_of(setting, settings));
  } else if (const auto flag = std::get_if<bool*>(&value)) {
    const std::string off = std::string(",!--no-") + setting.name;
    command.add_flag(**flag ? names + off : names, **flag, help);
  } else if (const auto count = std::get_if<std::uint32_t*>(&value)) {
    command.add_option(names, **count, help)
        ->capture_default_str()
        ->check(program::count_from(std::uint64_t(setting.min), std::uint64_t(setting.max)));
  } else if (const auto number = std::get_if<float*>(&value)) {
    command.add_option(names, **number, help)
        ->capture_default_str()
        ->check(program::number_from(setting.min, setting.max));
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

void declare_projection(CLI::App& command, std::string& projection) {
  command
      .add_option(
          "--projection", projection,
          "perspective; fisheye: equidistant, a hemisphere across the shorter side, around "
          "the view's direction; or equirectangular: all directions, longitude by latitude, "
          "with the view's direction in the middle (--size 2:1)")
      ->capture_default_str()
      ->check(CLI::IsMember({"perspective", "fisheye", "equirectangular"}));
}

void declare_size(CLI::App& command, std::string& size) {
  command.add_option("--size", size, "Picture size in pixels, WIDTHxHEIGHT")->capture_default_str();
}

namespace {

void warn_of_left_out(const std::string& name, const scene::RenderScene& scene) {
  for (const std::string& sentence : scene::describe_left_out(scene))
    spdlog::warn("{}: {}", name, sentence);
}

}  // namespace

scene::RenderScene load_and_report(const std::string& scene, const scene::PartSet& left_out) {
  scene::RenderScene loaded = scene::load_render_scene(scene::find_scene_file(scene), left_out);
  warn_of_left_out(scene, loaded);
  return loaded;
}

void RenderOptions::declare(CLI::App& command) {
  command_ = &command;
  std::string presets;
  for (const std::string& name : scene::camera_presets())
    presets += (presets.empty() ? "" : ", ") + name;
  declare_scene(command, scene);
  declare_size(command, size);
  for (const render::Setting& setting : render::list_settings())
    declare_setting(command, setting, settings);
  command.add_option("--settings", settings_file,
                     "TOML file whose table [render] holds values of these options, as nightview "
                     "price writes it; options of the command line go before it");
  command
      .add_option("--preset", preset,
                  "Settings for this kind of device, from fast to accurate, that were measured "
                  "(nightview presets): fast, balanced, accurate or reference; single options and "
                  "those of --settings go before it")
      ->check(CLI::IsMember(render::list_preset_names()));
  command
      .add_option(
          "--leave-out", leave_out,
          "Parts of the model that are left out, comma-separated:" + render::describe_model_parts())
      ->default_str("none");
  command
      .add_option("--time", time,
                  "Time of the night, HH:MM or HH:MM:SS (seconds may have a fraction)")
      ->capture_default_str();
  declare_device(command, device);
  command
      .add_option("--camera", camera,
                  "Camera file (JSON), preset (" + presets +
                      ") or street:NAME, with a part of a street's name")
      ->capture_default_str();
  command.add_option("--sky-map", sky_map,
                     "EXR of the sky's luminance by direction in cd/m2, latitude-longitude with "
                     "north in the middle; --sky becomes a factor for it");
  command
      .add_option("--lights", lights,
                  "Kinds of light that shine when it is their time: all, none, or a list of "
                  "lamp, window, headlamp, tail_lamp and other")
      ->capture_default_str();
  command.add_option("--edits", edits,
                     "File of edited lights that goes over the scene's, as the window writes it "
                     "(city.edits.json)");
  command.add_option("--moon", moon,
                     "Moon: AZIMUTH,ELEVATION in degrees (azimuth from north over east), or with "
                     ",LUX (full moon: 0.25)");
}

bool RenderOptions::is_given(const std::string& option) const {
  const CLI::Option* declared = command_->get_option_no_throw("--" + option);
  return declared && declared->count() > 0;
}

namespace {

// Returns the text of a value as a command line would take it: the name of a file beside the
// settings file gets its folder.
std::string find_beside(const render::SettingsFile& file, const render::NamedText& value) {
  if (value.name != "sky-map" && value.name != "camera") return value.text;
  const std::filesystem::path beside = file.path.parent_path() / value.text;
  return std::filesystem::exists(beside) ? beside.string() : value.text;
}

}  // namespace

void RenderOptions::apply_preset(const std::string& name) {
  const std::vector<gpu::DeviceInfo> devices = gpu::list_devices();
  const std::string kind = devices.at(gpu::choose_device(devices, device.select)).kind;
  render::apply_preset(render::find_device_class(kind), name, settings,
                       [&](const std::string& setting) { return is_given(setting); });
}

void RenderOptions::read_settings() {
  render::SettingsFile file;
  if (!settings_file.empty()) file = render::read_settings_file(settings_file);
  if (const render::NamedText* named = file.find("preset"); named && preset.empty())
    preset = named->text;
  has_sky_ = is_given("sky") || is_given("sky-map") || file.find("sky") || file.find("sky-map");
  if (!preset.empty()) apply_preset(preset);
  apply_settings_file(file, settings, [&](const std::string& name) { return is_given(name); });
  for (const render::NamedText& value : file.render) {
    // Those that are no render settings are options that hold text.
    CLI::Option* option = command_->get_option_no_throw("--" + value.name);
    if (!option || option->count() > 0 || render::find_setting(value.name)) continue;
    option->add_result(find_beside(file, value));
    try {
      option->run_callback();
    } catch (const CLI::Error& error) {
      throw UsageError(file.path.string(), value.line, error.what());
    }
  }
}

void RenderOptions::resolve() {
  read_settings();
  if (to_be_looked_at && !has_sky_)
    render::set_from_text(*render::find_setting("sky"), settings, "auto");
  left_out = render::LeftOut(leave_out);
  render::EnvironmentSettings& environment = settings.environment;
  if (!sky_map.empty() && environment.glow != render::SkyGlow::none)
    throw UsageError("--sky-map", "is another sky than --sky auto or overcast: give one of them");
  environment.sky_cd_m2 = glm::vec3(environment.sky_cd_m2.x);
  if (!sky_map.empty() && environment.sky_cd_m2 == glm::vec3(0))
    environment.sky_cd_m2 = glm::vec3(1);
  if (!moon.empty()) {
    const render::MoonPosition place = render::parse_moon(moon);
    render::set_moon(environment, place.azimuth_deg, place.elevation_deg, place.lux);
  }
  environment.lights = scene::parse_families(lights);
  left_out.apply(settings);
  settings.time_s = render::parse_time(time);
  const render::PictureSize parsed = render::parse_size(size);
  width = parsed.width;
  height = parsed.height;
}

void RenderOptions::make_sky(const std::string& name, scene::RenderScene& loaded) const {
  const render::EnvironmentSettings& environment = settings.environment;
  scene::Atmosphere air;
  air.overcast = environment.glow == render::SkyGlow::overcast;
  scene::CitySky sky = scene::make_city_sky(loaded, settings.time_s, environment.lights, air,
                                            1000 * double{environment.city_radius_km});
  loaded.sky_map = std::move(sky.map);
  const double direct = sky.glow.direct_lm, all = sky.glow.flux_lm();
  const float* zenith = loaded.sky_map.rgb.data();
  spdlog::info(
      "{}: of {:.3g} lm, {:.3g} leave upwards ({:.0f} % of them straight); with the city going on "
      "to "
      "{:g} km, the sky has {:.2g} cd/m2 at the zenith",
      name, sky.glow.lamp_flux_lm, all, all > 0 ? 100 * direct / all : 0,
      environment.city_radius_km, tonemap::luminance_709(zenith[0], zenith[1], zenith[2]));
}

scene::RenderScene RenderOptions::load(const std::string& other,
                                       const scene::TakeTraits& take) const {
  scene::RenderScene loaded = load(other, left_out.of_scene(), take);
  warn_of_left_out(other, loaded);
  return loaded;
}

scene::RenderScene RenderOptions::load(const std::string& other, const scene::PartSet& parts,
                                       const scene::TakeTraits& take) const {
  const auto with_sky = [&](scene::SceneTraits traits) {
    traits.sky_map = settings.environment.glow != render::SkyGlow::none || !sky_map.empty();
    if (take) take(traits);
  };
  scene::RenderScene loaded =
      scene::load_render_scene(scene::find_scene_file(other), parts, with_sky);
  if (!edits.empty()) {
    const LightEdits by_hand = read_light_edits(edits);
    const std::size_t unknown = apply_edits(by_hand, loaded.lights);
    loaded.has_edited_lights = unknown < by_hand.size();
    if (unknown > 0) spdlog::warn("{}: {} lights are not in {}", edits, unknown, other);
  }
  throw_if_cancelled();  // the window's thread reads here
  if (settings.environment.glow != render::SkyGlow::none) make_sky(other, loaded);
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
