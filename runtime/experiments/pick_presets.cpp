#include "runtime/experiments/pick_presets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "formats/error.h"
#include "runtime/experiments/sweep_points.h"
#include "runtime/experiments/sweep_table.h"

namespace nightcity::experiments {
namespace {

using Row = std::vector<std::string>;

double read_number(const measure::Table& table, const Row& row, const char* column) {
  return std::atof(row[table.column(column)].c_str());
}

bool is_unbiased(const std::string& estimator) {
  const render::EstimatorTraits& traits = render::traits_of(render::find_estimator(estimator));
  return traits.samples && !traits.as_published;
}

// Returns whether a row is not of half rate, which is biased.
bool samples_every_pixel(const measure::Table& table, const Row& row) {
  return row[table.column("half-rate")] != "yes";
}

// Returns the swept settings that have more than one value in the rows.
std::vector<render::Setting> list_varied(const measure::Table& table,
                                         const std::vector<const Row*>& rows) {
  std::vector<render::Setting> varied;
  for (const render::Setting& setting : list_swept_settings()) {
    std::set<std::string> values;
    for (const Row* row : rows) {
      const std::string& value = (*row)[table.column(render::column_of(setting))];
      if (value != "-") values.insert(value);
    }
    // The estimator is always named: a preset does not depend on the default.
    if (values.size() > 1 || std::string(setting.name) == "estimator") varied.push_back(setting);
  }
  return varied;
}

std::string describe(const measure::Table& table, const Row& row,
                     const std::vector<render::Setting>& varied) {
  std::string text;
  for (const render::Setting& setting : varied) {
    const std::string& value = row[table.column(render::column_of(setting))];
    if (value != "-") text += (text.empty() ? "" : " ") + std::string(setting.name) + "=" + value;
  }
  return text;
}

}  // namespace

std::vector<SweptSettings> read_swept_settings(const measure::Table& sweep) {
  long fewest = 0;
  for (const Row& row : sweep.rows) {
    const long frames = std::lround(read_number(sweep, row, "frames"));
    fewest = fewest == 0 ? frames : std::min(fewest, frames);
  }
  std::vector<const Row*> rows;
  std::set<std::string> views;
  for (const Row& row : sweep.rows) {
    views.insert(row[sweep.column("view")]);
    if (std::lround(read_number(sweep, row, "frames")) == fewest &&
        is_unbiased(row[sweep.column("estimator")]) && samples_every_pixel(sweep, row) &&
        read_number(sweep, row, "ms") > 0 && read_number(sweep, row, "relative_mse") > 0)
      rows.push_back(&row);
  }
  const std::vector<render::Setting> varied = list_varied(sweep, rows);
  struct Sums {
    double log_ms = 0, log_error = 0;
    std::set<std::string> views;
    double rows = 0;
  };
  std::map<std::string, Sums> sums;
  for (const Row* row : rows) {
    Sums& sum = sums[describe(sweep, *row, varied)];
    sum.log_ms += std::log(read_number(sweep, *row, "ms"));
    sum.log_error += std::log(read_number(sweep, *row, "relative_mse"));
    sum.views.insert((*row)[sweep.column("view")]);
    ++sum.rows;
  }
  std::vector<SweptSettings> combinations;
  std::vector<std::pair<double, double>> points;
  for (const auto& [settings, sum] : sums)
    if (sum.views == views)
      combinations.push_back(
          {settings, std::exp(sum.log_ms / sum.rows), std::exp(sum.log_error / sum.rows), false});
  if (combinations.empty())
    throw Error("sweep.csv", "has no combination of an unbiased estimator in every view");
  std::sort(combinations.begin(), combinations.end(),
            [](const SweptSettings& a, const SweptSettings& b) { return a.ms < b.ms; });
  for (const SweptSettings& each : combinations) points.emplace_back(each.ms, each.relative_mse);
  const std::vector<bool> front = find_front(points);
  for (std::size_t i = 0; i < combinations.size(); ++i) combinations[i].on_front = front[i];
  return combinations;
}

PresetPicks pick_presets(const std::vector<SweptSettings>& combinations, double max_ratio) {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < combinations.size(); ++i)
    if (combinations[i].on_front) front.push_back(i);
  if (front.empty()) throw Error("sweep.csv", "has no Pareto front");
  const auto& at = [&](std::size_t i) -> const SweptSettings& { return combinations[front[i]]; };
  const std::size_t accurate = front.size() - 1;  // the front's errors fall
  std::size_t fast = 0;
  while (at(fast).relative_mse > max_ratio * at(accurate).relative_mse) ++fast;
  const double ms_range = std::log(at(accurate).ms / at(fast).ms),
               error_range = std::log(at(fast).relative_mse / at(accurate).relative_mse);
  std::size_t balanced = fast;
  double deepest = 0;
  for (std::size_t i = fast + 1; i < accurate; ++i) {
    const double x = std::log(at(i).ms / at(fast).ms) / ms_range,
                 y = std::log(at(i).relative_mse / at(accurate).relative_mse) / error_range;
    if (const double below = 1 - x - y; below > deepest) {
      deepest = below;
      balanced = i;
    }
  }
  return {front[fast], front[balanced], front[accurate]};
}

std::string to_preset_lines(const std::string& device_class,
                            const std::vector<SweptSettings>& combinations,
                            const PresetPicks& picks) {
  std::string text;
  const auto add = [&](const char* name, const std::string& settings) {
    text += "{\"" + device_class + "\", \"" + name + "\", \"" + settings + "\"},\n";
  };
  add("fast", combinations[picks.fast].settings);
  add("balanced", combinations[picks.balanced].settings);
  add("accurate", combinations[picks.accurate].settings);
  add("reference", "estimator=reference");
  return text;
}

}  // namespace nightcity::experiments
