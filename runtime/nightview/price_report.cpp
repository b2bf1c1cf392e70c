#include "runtime/nightview/price_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "formats/program/print_json.h"
#include "runtime/measure/table.h"
#include "runtime/render/parse.h"

namespace nightcity::nightview {
namespace {

using experiments::ErrorMeasure;
using measure::Estimate;

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

}  // namespace

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

}  // namespace nightcity::nightview
