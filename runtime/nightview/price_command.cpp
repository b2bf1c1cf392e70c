// nightview price SCENE.glb: what the scene requires of the model for a stated error, and what each
// part costs.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <utility>

#include "formats/error.h"
#include "formats/program/number_check.h"
#include "formats/program/output.h"
#include "formats/program/progress_display.h"
#include "runtime/nightview/commands.h"
#include "runtime/nightview/price_report.h"
#include "runtime/render/parse.h"
#include "runtime/render/settings_file.h"

namespace nightcity::nightview {
namespace {

using experiments::ErrorMeasure;

ErrorMeasure find_measure(const std::string& name) {
  if (name == "mean") return ErrorMeasure::mean;
  return name == "relative-rmse" ? ErrorMeasure::relative_rmse : ErrorMeasure::rmse;
}

// Writes the settings that render the chosen model in every command.
void write_settings(const PriceCommand& command, const experiments::PriceReport& report) {
  const experiments::PriceOptions& options = command.price;
  render::RenderSettings settings = options.settings;
  report.chosen.left_out.apply(settings);
  settings.indirect.bounces = report.chosen.bounces;
  settings.sampling.jitter = command.render.settings.sampling.jitter;
  render::RenderSettings defaults;
  defaults.indirect.bounces = settings.indirect.bounces + 1;  // commands start from unlike numbers
  render::SettingsFile file{command.out, list_changes(settings, defaults), {}};
  if (settings.environment.moon_lux != glm::vec3(0))
    file.render.push_back({"moon", command.render.moon});
  if (!command.render.sky_map.empty() && settings.environment.sky_cd_m2 != glm::vec3(0))
    file.render.push_back({"sky-map", std::filesystem::absolute(command.render.sky_map).string()});
  file.render.push_back({"leave-out", render::name_parts(report.chosen.left_out.of_scene())});
  std::erase_if(file.render, [](const render::NamedText& value) {
    return value.name == "leave-out" && value.text.empty();
  });
  const std::string comment = fmt::format(
      "The smallest model of {} within an error of {:g} ({}), measured by nightview price\n"
      "at {} with {} pictures of {} frames, {} x {}, on {}.\n"
      "{}",
      std::filesystem::path(command.render.scene).filename().string(), options.limit,
      command.measure, render::time_text(options.settings.time_s), options.runs, options.frames,
      options.width, options.height, report.device,
      report.choice.cuts.empty()
          ? "Nothing that saves anything can be left out."
          : fmt::format("It is off by {:.4g}, below {:.4g} with two standard errors.",
                        report.chosen.error, report.chosen.bound));
  write_settings_file(file, comment);
}

void price(PriceCommand& command) {
  RenderOptions& render = command.render;
  render.resolve();
  if (!command.out.empty() && !command.against.empty())
    throw UsageError("--against", "measures other scenes and chooses no settings: omit --out");
  if (render.settings.sampling.resolution_scale < 1)
    throw UsageError("--resolution-scale",
                     "is no part of a model: pictures are measured at their size");
  if (!command.out.empty()) program::require_writable_folder_of(command.out);
  experiments::PriceOptions& options = command.price;
  options.device = render.device;
  options.width = render.width;
  options.height = render.height;
  options.settings = render.settings;
  options.settings.sampling.jitter = false;  // edges are not what is measured
  options.left_out = render.left_out;
  options.measure = find_measure(command.measure);
  for (const std::string& other : command.against)
    options.others.emplace_back(other, [&render, other](const scene::PartSet& left_out) {
      return render.load(other, left_out);
    });
  if (!command.views.empty()) options.views = render::split_list("--views", command.views);
  // A warning names things in the files that no picture shows; one is enough for all models.
  options.load = [&render, is_first = true](const scene::PartSet& left_out) mutable {
    return std::exchange(is_first, false) ? render.load() : render.load(left_out);
  };
  program::ProgressDisplay progress;
  const experiments::PriceReport report = price_scene(options, progress);
  progress.clear();
  if (command.json)
    print_as_json(command, report);
  else
    print_as_table(command, report);
  if (command.out.empty()) return;
  write_settings(command, report);
  if (!command.json) fmt::print("{}\n", command.out);
}

void declare_effort(CLI::App& sub, PriceCommand& command) {
  experiments::PriceOptions& options = command.price;
  sub.add_option("--runs", options.runs,
                 "Pictures of each model and view, with random numbers of their own: from their "
                 "spread come the standard errors")
      ->capture_default_str()
      ->check(program::count_from(3, 1000));
  sub.add_option("--frames", options.frames, "Frames averaged in each picture")
      ->capture_default_str()
      ->check(program::count_from(1, 100000));
  sub.add_option("--timed-frames", options.timed,
                 "Frames of each model and view that are timed, in turn with the whole model's")
      ->capture_default_str()
      ->check(program::count_from(1, 100000));
}

}  // namespace

void add_price_command(CLI::App& app) {
  auto command = std::make_shared<PriceCommand>();
  CLI::App* sub = app.add_subcommand(
      "price", "Measure what each part of the model is worth in this scene, and what it costs");
  sub->footer(
      "Every part that the scene has is left out in turn: the error of that against the whole "
      "model, free of\n"
      "noise, beside the milliseconds, bytes and load time that it saves. Then the smallest model "
      "that keeps\n"
      "the stated error, verified by rendering it: --settings FILE of every command takes it. See "
      "docs/price.md.\n"
      "Examples:\n"
      "  nightview price out/demo/city.glb\n"
      "  nightview price city.glb --error 0.5 --out cheap.toml\n"
      "  nightview render city.glb --settings cheap.toml -o night.png\n"
      "  nightview price city.glb --views city.cameras.json --time 23:30 --wet 0.8 --json\n"
      "  nightview price city.glb --against coarse/city.glb --against draco/city.glb\n"
      "  nightview price city.glb --size 96x54 --frames 16 --by mean --error 0.01");
  command->render.size = "320x180";
  command->render.settings.indirect.bounces = render::picture_bounces;
  command->render.declare(*sub);
  sub->add_option("--views", command->views,
                  "Cameras, comma-separated: presets, files of a camera, or files of many as the "
                  "window's bookmarks are")
      ->default_str("overview,street");
  sub->add_option("--against", command->against,
                  "Other bakes of the same city: in place of parts, the error of each against the "
                  "scene, and what it saves; may be repeated");
  sub->add_option("--error", command->price.limit,
                  "Error that the smallest model may have, greatest over the views, with two "
                  "standard errors: in units of --by")
      ->capture_default_str()
      ->check(program::number_from(0, 1e6));
  sub->add_option("--by", command->measure,
                  "Measure of that error: rmse, of 8-bit display values; mean, relative mean "
                  "signed error; relative-rmse, root of the relative MSE")
      ->capture_default_str()
      ->check(CLI::IsMember({"rmse", "mean", "relative-rmse"}));
  declare_effort(*sub, *command);
  program::add_output_option(*sub, command->out, "Settings file (TOML) of the smallest model");
  sub->add_flag("--json", command->json, "Print the results as JSON");
  sub->callback([command] { price(*command); });
}

}  // namespace nightcity::nightview
