// nightview price SCENE.glb: what the scene requires of the model for a stated error, and what each
// part costs.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "formats/error.h"
#include "formats/program/number_check.h"
#include "formats/program/output.h"
#include "formats/program/print_json.h"
#include "formats/program/progress_display.h"
#include "runtime/experiments/price.h"
#include "runtime/measure/table.h"
#include "runtime/nightview/commands.h"
#include "runtime/nightview/render_options.h"
#include "runtime/render/parse.h"
#include "runtime/render/settings_file.h"

namespace nightcity::nightview {
namespace {

using experiments::ErrorMeasure;
using measure::Estimate;

struct PriceCommand {
  RenderOptions render;
  experiments::PriceOptions price;
  std::string views, measure = "rmse", out;
  std::vector<std::string> against;
  bool json = false;
};

ErrorMeasure find_measure(const std::string& name) {
  if (name == "mean") return ErrorMeasure::mean;
  return name == "relative-rmse" ? ErrorMeasure::relative_rmse : ErrorMeasure::rmse;
}

std::string with_error(const char* format, const Estimate& estimate, double factor = 1) {
  return fmt::format(fmt::runtime(format), factor * estimate.value) + " +- " +
         fmt::format("{:.1g}", factor * estimate.error);
}

std::string to_mb(double bytes) {
  return fmt::format("{:.2f}", bytes / 1e6);
}

// Returns a row of the table: its cells for a view, and those that all views share.
std::vector<std::string> make_row(const experiments::SimplerModel& model, const std::string& view,
                                  const measure::ModelDifference& d) {
  return {model.name,
          fmt::to_string(model.count),
          view,
          with_error("{:+.3f}", d.relative_mean, 100),
          with_error("{:.3f}", d.rmse8()),
          with_error("{:.4g}", d.relative_mse),
          with_error("{:+.3g}", model.saved.ms),
          to_mb(model.saved.bytes),
          fmt::format("{:+.2f}", model.saved.load_s)};
}

measure::Table make_table(const experiments::PriceReport& report) {
  measure::Table table{{"left out", "things", "view", "mean, %", "RMSE (8-bit)", "relative MSE",
                        "saves ms", "saves MB", "saves load s"},
                       {}};
  const auto add = [&](const experiments::SimplerModel& model) {
    for (std::size_t view = 0; view < model.views.size(); ++view)
      table.rows.push_back(make_row(model, report.views[view], model.views[view]));
  };
  for (const std::size_t row : report.measured) add(report.rows[row]);
  if (!report.chosen.views.empty()) {
    experiments::SimplerModel chosen = report.chosen;
    chosen.name = "**chosen**: " + chosen.name;
    chosen.count = report.choice.cuts.size();
    add(chosen);
  }
  return table;
}

std::string list_absent(const experiments::PriceReport& report) {
  std::string names;
  for (const experiments::SimplerModel& row : report.rows)
    if (row.count == 0) names += (names.empty() ? "" : ", ") + row.name;
  return names;
}

// Returns the parts for which noise hides whether leaving them out keeps the limit.
std::string list_undecided(const experiments::PriceReport& report, double limit) {
  std::string names;
  for (const experiments::SimplerModel& row : report.rows)
    if (row.least <= limit && row.bound > limit) names += (names.empty() ? "" : ", ") + row.name;
  return names;
}

// Returns the rows in which pixels that see lamps do not count, and how many those are.
std::string describe_lamps_seen(const experiments::PriceReport& report) {
  std::string names, shares;
  for (const std::size_t row : report.measured)
    if (report.rows[row].without_lamps_seen)
      names += (names.empty() ? "" : ", ") + report.rows[row].name;
  if (names.empty()) return "";
  for (std::size_t i = 0; i < report.views.size(); ++i)
    shares += fmt::format("{}{:.2g} % of {}", i == 0 ? "" : ", ", 100 * report.lamps_seen[i],
                          report.views[i]);
  return fmt::format(
      "Pixels that see a lamp itself ({}) do not count in: {}. They would look otherwise, whatever "
      "the lamp lights.\n",
      shares, names);
}

void print_as_table(const PriceCommand& command, const experiments::PriceReport& report) {
  const experiments::PriceOptions& options = command.price;
  fmt::print("{}: {} triangles, {} lights, {} x {}, {}, {} pictures of {} frames a side, on {}\n",
             command.render.scene, report.triangles, report.lights, options.width, options.height,
             render::name_of(options.settings.sampling.estimator), options.runs, options.frames,
             report.device);
  fmt::print("The whole model: {} ms a frame, {} MB on the device, loaded in {:.2f} s.\n\n",
             with_error("{:.3g}", report.whole.ms), to_mb(report.whole.bytes), report.whole.load_s);
  fmt::print("{}\n", measure::to_markdown(make_table(report)));
  if (!command.against.empty()) return;
  fmt::print("{}", describe_lamps_seen(report));
  if (const std::string absent = list_absent(report); !absent.empty())
    fmt::print("Absent here: {}.\n", absent);
  if (const std::string names = list_undecided(report, options.limit); !names.empty())
    fmt::print(
        "Two standard errors reach across the limit of {:.4g}: {}. More --frames or --runs would "
        "decide.\n",
        options.limit, names);
  const char* unit = options.measure == ErrorMeasure::mean ? " of the mean" : "";
  if (report.choice.cuts.empty())
    fmt::print("Nothing that saves anything can be left out within an error of {:.4g}{}.\n",
               options.limit, unit);
  else
    fmt::print(
        "Within an error of {:.4g}{} this scene does without: {}. Rendered anew, that model is off "
        "by {:.4g}, below {:.4g} with two standard errors.\n",
        options.limit, unit, report.chosen.name, report.chosen.error, report.chosen.bound);
}

nlohmann::ordered_json to_json(const Estimate& estimate) {
  return {{"value", estimate.value}, {"standard_error", estimate.error}};
}

nlohmann::ordered_json to_json(const experiments::SimplerModel& model,
                               const experiments::PriceReport& report) {
  nlohmann::ordered_json json{{"name", model.name}, {"help", model.help}, {"things", model.count}};
  json["present"] = !model.views.empty();
  json["without_pixels_that_see_lamps"] = model.without_lamps_seen;
  if (model.views.empty()) return json;
  for (std::size_t i = 0; i < model.views.size(); ++i) {
    const measure::ModelDifference& d = model.views[i];
    json["views"].push_back({{"view", report.views[i]},
                             {"relative_mean_signed_error", to_json(d.relative_mean)},
                             {"rmse8", to_json(d.rmse8())},
                             {"relative_mse", to_json(d.relative_mse)}});
  }
  json["saved_ms"] = to_json(model.saved.ms);
  json["saved_bytes"] = model.saved.bytes;
  json["saved_load_s"] = model.saved.load_s;
  json["saving"] = model.saving;
  json["error"] = model.error;
  json["error_less_two_standard_errors"] = model.least;
  json["error_with_two_standard_errors"] = model.bound;
  return json;
}

nlohmann::ordered_json list_trials(const experiments::PriceReport& report) {
  auto trials = nlohmann::ordered_json::array();
  for (const experiments::Trial& trial : report.choice.trials) {
    auto names = nlohmann::ordered_json::array();
    for (const std::size_t cut : trial.cuts)
      names.push_back(report.rows[report.measured[cut]].name);
    trials.push_back({{"left_out", names},
                      {"error_with_two_standard_errors", trial.error},
                      {"kept", trial.is_kept},
                      {"verification", trial.is_verification}});
  }
  return trials;
}

void print_as_json(const PriceCommand& command, const experiments::PriceReport& report) {
  const experiments::PriceOptions& options = command.price;
  nlohmann::ordered_json json{{"scene", command.render.scene},
                              {"device", report.device},
                              {"triangles", report.triangles},
                              {"lights", report.lights},
                              {"size", {options.width, options.height}},
                              {"time", render::time_text(options.settings.time_s)},
                              {"estimator", render::name_of(options.settings.sampling.estimator)},
                              {"bounces", options.settings.indirect.bounces},
                              {"left_out", options.left_out.text()},
                              {"runs", options.runs},
                              {"frames", options.frames},
                              {"measure", command.measure},
                              {"limit", command.price.limit}};
  for (std::size_t i = 0; i < report.views.size(); ++i)
    json["views"].push_back({{"view", report.views[i]},
                             {"mean_cd_m2", report.means[i]},
                             {"pixels_that_see_lamps", report.lamps_seen[i]}});
  json["whole"] = {{"ms", to_json(report.whole.ms)},
                   {"bytes", report.whole.bytes},
                   {"load_s", report.whole.load_s}};
  for (const experiments::SimplerModel& row : report.rows)
    json["parts"].push_back(to_json(row, report));
  if (!command.against.empty()) return program::print_json(json);
  json["trials"] = list_trials(report);
  json["chosen"] = to_json(report.chosen, report);
  json["chosen"]["leave_out"] = report.chosen.left_out.text();
  json["chosen"]["bounces"] = report.chosen.bounces;
  program::print_json(json);
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
