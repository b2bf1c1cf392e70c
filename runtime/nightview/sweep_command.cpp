// nightview sweep SCENE.glb --out DIR: error against cost for every combination of settings.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "formats/error.h"
#include "formats/program/number_check.h"
#include "formats/program/output.h"
#include "runtime/experiments/sweep.h"
#include "runtime/experiments/sweep_points.h"
#include "runtime/nightview/commands.h"
#include "runtime/nightview/device_options.h"
#include "runtime/nightview/render_options.h"
#include "runtime/render/model_parts.h"
#include "runtime/render/settings_file.h"
#include "runtime/scene/light_families.h"
#include "runtime/scene/scene_file.h"

namespace nightcity::nightview {
namespace {

struct SweepCommand {
  experiments::SweepOptions options;
  std::string size = "640x360", views = "overview", frames = "1,16", settings_file;
  const CLI::App* app = nullptr;
};

bool is_given(const SweepCommand& command, const std::string& option) {
  return command.app->count("--" + option) > 0;
}

// Takes over a value of a settings file: what is swept becomes a list of one value, the rest is the
// same at every point.
void take(SweepCommand& command, const render::NamedText& value, render::LeftOut& left_out) {
  experiments::SweepOptions& options = command.options;
  render::EnvironmentSettings& environment = options.base.environment;
  if (const render::Setting* setting = render::find_setting(value.name)) {
    if (!setting->is_swept)
      set_from_text(*setting, options.base, value.text);
    else if (std::string& list = options.values[setting->name]; list.empty())
      list = value.text;
  } else if (value.name == "leave-out") {
    left_out = render::LeftOut(value.text);
  } else if (value.name == "time") {
    options.base.time_s = render::parse_time(value.text);
  } else if (value.name == "lights") {
    environment.lights = scene::parse_families(value.text);
  } else if (value.name == "moon") {
    const render::MoonPosition moon = render::parse_moon(value.text);
    render::set_moon(environment, moon.azimuth_deg, moon.elevation_deg, moon.lux);
  } else if (value.name == "size" && !is_given(command, "size")) {
    command.size = value.text;
  } else if (value.name == "camera" && !is_given(command, "views")) {
    command.views = value.text;
  } else if (value.name == "sky-map") {
    spdlog::warn("{}: a sweep has no sky map", command.settings_file);
  }
}

void take_settings(SweepCommand& command) {
  if (command.settings_file.empty()) return;
  render::LeftOut left_out;
  for (const render::NamedText& value : render::read_settings_file(command.settings_file).render)
    take(command, value, left_out);
  render::EnvironmentSettings& environment = command.options.base.environment;
  if (environment.glow != render::SkyGlow::none) {
    spdlog::warn("{}: a sweep has no sky map, so its sky is dark", command.settings_file);
    environment.glow = render::SkyGlow::none;
    environment.sky_cd_m2 = glm::vec3(0);
  }
  environment.sky_cd_m2 = glm::vec3(environment.sky_cd_m2.x);
  left_out.apply(command.options.base);
  command.options.left_out = left_out.of_scene();
}

std::vector<std::uint32_t> parse_rising_counts(const std::string& text) {
  std::vector<std::uint32_t> counts;
  for (const std::size_t count : render::parse_counts("--frames", text, 1, 1'000'000)) {
    if (!counts.empty() && count <= counts.back())
      throw UsageError("--frames", "'" + text + "' does not rise from number to number");
    counts.push_back(static_cast<std::uint32_t>(count));
  }
  return counts;
}

void sweep(SweepCommand& command) {
  experiments::SweepOptions& options = command.options;
  options.scene = scene::find_scene_file(options.scene).string();
  take_settings(command);
  options.size = render::parse_size(command.size);
  options.views = render::split_list("--views", command.views);
  options.frames = parse_rising_counts(command.frames);
  program::ProgressDisplay progress;
  const experiments::SweepReport report = run_sweep(options, progress);
  progress.clear();
  if (report.done < report.total)
    spdlog::warn(
        "stopped after {} minutes with {} of {} combinations done; the same command continues",
        options.minutes, report.done, report.total);
  fmt::print("{}\n", (options.folder / "sweep.csv").string());
}

void declare_swept_settings(CLI::App& command, experiments::SweepOptions& options) {
  for (const render::Setting& setting : experiments::list_swept_settings()) {
    std::string names = render::option_of(setting), help = render::describe(setting);
    for (const char* alias : setting.aliases) names += std::string(",--") + alias;
    render::RenderSettings defaults;
    if (std::holds_alternative<bool*>(setting.value(defaults))) help += "; yes or no";
    command.add_option(names, options.values[setting.name], help)
        ->default_str(render::default_list(setting));
  }
}

}  // namespace

void add_sweep_command(CLI::App& app) {
  auto command = std::make_shared<SweepCommand>();
  experiments::SweepOptions& options = command->options;
  CLI::App* sub = app.add_subcommand(
      "sweep",
      "Measure error against milliseconds for every combination of settings, and mark the Pareto "
      "front: CSV, JSON, Markdown and a plot");
  sub->footer(
      "Lists are comma-separated. DIR gets sweep.csv, sweep.json, sweep.md, sweep-VIEW.svg and "
      "the\n"
      "reference pictures. The front: no other combination is faster with an error as small. "
      "Columns "
      "_ci95\n"
      "are half the widths of 95 % confidence intervals over --repeats. A second run continues "
      "where the first stopped, and starts over where the scene "
      "changed.\n"
      "Examples:\n"
      "  nightview sweep city.glb --out sweep --estimator paper,pairwise --candidates "
      "1,2,4,8,16,32\n"
      "  nightview sweep city.glb --out sweep --size 1920x1080 --views overview,street \\\n"
      "      --frames 1,30 --minutes 9\n"
      "  nightview sweep city.glb --out moving --frames 1 --time-step 0.0333");
  command->app = sub;
  declare_scene(*sub, options.scene);
  sub->add_option(
      "--settings", command->settings_file,
      "Settings file (TOML): its values take the place of lists that are not given, and "
      "its time, sky and parts left out those of the scene");
  program::add_output_option(*sub, options.folder, "Folder of the results")->required();
  sub->add_option("--views", command->views, "Cameras: files or presets")->capture_default_str();
  declare_size(*sub, command->size);
  sub->add_option("--frames", command->frames,
                  "Measure the mean of each of these numbers of frames, in rising order")
      ->capture_default_str();
  declare_swept_settings(*sub, options);
  sub->add_option("--warm-up", options.warm_up,
                  "Frames before the first that counts: they fill the history")
      ->capture_default_str()
      ->check(program::count_from(0, 100000));
  sub->add_option("--repeats", options.repeats, "Seeds whose errors are averaged")
      ->capture_default_str()
      ->check(program::count_from(1, 1000));
  sub->add_option("--reference-frames", options.reference_frames, "Frames of the reference picture")
      ->capture_default_str()
      ->check(program::count_from(1, 100000));
  sub->add_option("--time-step", options.time_step_s,
                  "Seconds by which the clock moves on before every frame, up to the measured one; "
                  "0 = it stands still. Needs --frames 1")
      ->capture_default_str()
      ->check(program::number_from(0, 3600));
  sub->add_option("--minutes", options.minutes,
                  "Stop after the combination that takes longer than this; 0 = never")
      ->capture_default_str()
      ->check(program::number_from(0, 1e6));
  declare_device(*sub, options.device);
  sub->callback([command] { sweep(*command); });
}

}  // namespace nightcity::nightview
