// nightview upward SCENE.glb --out DIR: measures how much of the city's light leaves it upwards.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "formats/atomic_file.h"
#include "formats/program/number_check.h"
#include "formats/program/output.h"
#include "formats/program/print_json.h"
#include "runtime/measure/exr.h"
#include "runtime/measure/false_colour.h"
#include "runtime/measure/png.h"
#include "runtime/nightview/commands.h"
#include "runtime/nightview/device_options.h"
#include "runtime/nightview/render_options.h"
#include "runtime/render/model_parts.h"
#include "runtime/render/parse.h"
#include "runtime/render/settings_file.h"
#include "runtime/render/upward_flux.h"

namespace nightcity::nightview {
namespace {

struct UpwardCommand {
  std::string scene, out, time = "20:00", settings_file, leave_out;
  const CLI::App* app = nullptr;
  gpu::Device::Options device;
  render::UpwardSettings settings;
  bool json = false;
};

struct Sums {
  std::size_t lights = 0;
  double flux_lm = 0, direct_lm = 0, reflected_lm = 0, sideways_lm = 0;
  double upward_lm() const { return direct_lm + reflected_lm; }
  double share() const { return flux_lm > 0 ? upward_lm() / flux_lm : 0; }
};

using FamilySums = std::array<Sums, light_family_count>;

// Returns the family of a light: the light file names those of static lights, a vehicle's kind
// those of its lights.
LightFamily find_family(const scene::RenderScene& scene, std::size_t light) {
  if (light < scene.families.size()) return scene.families[light];
  const std::size_t moving = light - scene.families.size();
  const VehicleKind& kind =
      scene.traffic.vehicles[scene.traffic.trips[moving / VEHICLE_LIGHTS].vehicle];
  const std::size_t n = moving % VEHICLE_LIGHTS;
  if (n >= kind.light_count) return LightFamily::other;
  return static_cast<LightFamily>(scene.traffic.vehicle_lights[kind.first_light + n].id);
}

void write_lights(const std::filesystem::path& path, const scene::RenderScene& scene,
                  const render::UpwardFlux& flux) {
  AtomicFile file(path);
  std::string text = "light,family,flux_lm,direct_lm,reflected_lm,sideways_lm,upward_share\n";
  for (std::size_t i = 0; i < flux.lights.size(); ++i) {
    const double lm = flux.flux_lm[i];
    if (!(lm > 0)) continue;
    const auto& s = flux.lights[i];
    text +=
        fmt::format("{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", i, name_of(find_family(scene, i)),
                    lm, lm * s.direct, lm * s.reflected, lm * s.sideways, s.direct + s.reflected);
    if (text.size() > (1u << 20)) {
      file.write(text.data(), text.size());
      text.clear();
    }
  }
  file.write(text.data(), text.size());
  file.commit();
}

void write_map(const std::filesystem::path& folder, const render::UpwardFlux& flux) {
  measure::Image map;
  map.width = flux.width;
  map.height = flux.depth;
  std::vector<float> density;  // lm/m2, the luminous exitance of the square towards the sky
  for (const double lm : flux.cells_lm)
    density.push_back(static_cast<float>(lm / double(flux.cell_m * flux.cell_m)));
  for (const float d : density) map.rgb.insert(map.rgb.end(), {d, d, d});
  map.layers.push_back({"upward_lm_per_m2", {"Y"}, density});
  measure::write_exr(folder / "upward.exr", map);
  measure::write_png(folder / "upward.png",
                     measure::false_colour(density, map.width, map.height,
                                           measure::fitting_scale(density, "lm/m2")));
}

nlohmann::ordered_json to_json(const Sums& s) {
  return {{"lights", s.lights},           {"flux_lm", s.flux_lm},
          {"direct_lm", s.direct_lm},     {"reflected_lm", s.reflected_lm},
          {"sideways_lm", s.sideways_lm}, {"upward_share", s.share()}};
}

void print_as_json(const UpwardCommand& command, const Sums& all, const FamilySums& families) {
  nlohmann::ordered_json json{{"scene", command.scene},
                              {"time", command.time},
                              {"rays", command.settings.rays},
                              {"bounces", command.settings.bounces},
                              {"all", to_json(all)}};
  for (std::size_t f = 0; f < families.size(); ++f)
    if (families[f].lights > 0) json[name_of(static_cast<LightFamily>(f))] = to_json(families[f]);
  program::print_json(json);
}

void print_as_table(const Sums& all, const FamilySums& families) {
  fmt::print("{:<10} {:>9} {:>13} {:>13} {:>13} {:>9}\n", "", "lights", "flux lm", "direct up lm",
             "reflected lm", "share up");
  const auto print_row = [](const char* name, const Sums& s) {
    if (s.lights > 0)
      fmt::print("{:<10} {:>9} {:>13.0f} {:>13.0f} {:>13.0f} {:>8.2f}%\n", name, s.lights,
                 s.flux_lm, s.direct_lm, s.reflected_lm, 100 * s.share());
  };
  for (std::size_t f = 0; f < families.size(); ++f)
    print_row(name_of(static_cast<LightFamily>(f)), families[f]);
  print_row("all", all);
}

// Takes time and parts left out from the settings file, unless the command line gives them.
void take_settings(UpwardCommand& command) {
  if (command.settings_file.empty()) return;
  const render::SettingsFile file = render::read_settings_file(command.settings_file);
  const auto take = [&](const char* key, std::string& value) {
    const render::NamedText* named = file.find(key);
    if (named && command.app->count(std::string("--") + key) == 0) value = named->text;
  };
  take("time", command.time);
  take("leave-out", command.leave_out);
}

void upward(UpwardCommand& command) {
  take_settings(command);
  command.settings.time_s = render::parse_time(command.time);
  program::require_writable_folder(command.out);
  scene::RenderScene scene =
      load_and_report(command.scene, render::LeftOut(command.leave_out).of_scene());
  gpu::Device device(command.device);
  render::DeviceScene device_scene(device, scene, render::ReleaseGeometry{},
                                   {command.settings.time_s});
  render::PassLibrary passes(device);
  const render::UpwardFlux flux =
      render::measure_upward_flux(device, passes, device_scene, command.settings);
  device.check_validation();

  FamilySums families{};
  Sums all;
  for (std::size_t i = 0; i < flux.lights.size(); ++i) {
    if (!(flux.flux_lm[i] > 0)) continue;
    const std::size_t family =
        std::min<std::size_t>(std::size_t(find_family(scene, i)), families.size() - 1);
    for (Sums* sums : {&all, &families[family]}) {
      ++sums->lights;
      sums->flux_lm += flux.flux_lm[i];
      sums->direct_lm += flux.flux_lm[i] * flux.lights[i].direct;
      sums->reflected_lm += flux.flux_lm[i] * flux.lights[i].reflected;
      sums->sideways_lm += flux.flux_lm[i] * flux.lights[i].sideways;
    }
  }
  const std::filesystem::path folder(command.out);
  write_lights(folder / "upward.csv", scene, flux);
  write_map(folder, flux);

  if (command.json) {
    print_as_json(command, all, families);
  } else {
    print_as_table(all, families);
    for (const char* name : {"upward.csv", "upward.png", "upward.exr"})
      fmt::print("{}\n", (folder / name).string());
  }
}

}  // namespace

void add_upward_command(CLI::App& app) {
  auto command = std::make_shared<UpwardCommand>();
  CLI::App* sub = app.add_subcommand(
      "upward", "Measure how much of each lamp's light leaves the city upwards, and map where");
  sub->footer(
      "Writes upward.csv (each light's lumens that go straight up, and up off surfaces), and\n"
      "upward.png and .exr (a map from above, in lumens per square metre).\n"
      "Examples:\n"
      "  nightview upward out/demo/city.glb --out out/upward\n"
      "  nightview upward city.glb --out dark --time 23:00 --cell 2 --rays 4096 --json");
  command->app = sub;
  declare_scene(*sub, command->scene);
  sub->add_option("--settings", command->settings_file,
                  "Settings file (TOML): its time, and the parts that it leaves out");
  sub->add_option("--leave-out", command->leave_out,
                  "Parts of the scene that are left out, as in nightview render")
      ->default_str("none");
  program::add_output_option(*sub, command->out, "Folder of the results")->required();
  sub->add_option("--time", command->time, "Time of the night, HH:MM or HH:MM:SS")
      ->capture_default_str();
  sub->add_option("--rays", command->settings.rays, "Rays per light")
      ->capture_default_str()
      ->check(program::count_from(1, 1u << 20));
  sub->add_option("--bounces", command->settings.bounces,
                  "Surfaces that light may bounce off on its way up; 1 = the first one alone")
      ->capture_default_str()
      ->check(program::count_from(0, MAX_BOUNCES));
  sub->add_option("--cell", command->settings.cell_m, "Side of the map's squares, m")
      ->capture_default_str()
      ->check(program::number_from(0.1, 10'000));
  sub->add_option("--seed", command->settings.seed, "Seed of all random numbers")
      ->check(program::count_from(0, 0xFFFFFFFF))
      ->capture_default_str();
  declare_device(*sub, command->device);
  sub->add_flag("--json", command->json, "Print the results as JSON");
  sub->callback([command] { upward(*command); });
}

}  // namespace nightcity::nightview
