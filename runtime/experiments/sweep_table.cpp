#include "runtime/experiments/sweep_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/program/output.h"
#include "formats/program/print_json.h"
#include "formats/small_file.h"
#include "runtime/experiments/sweep_points.h"

namespace nightcity::experiments {
namespace {

std::string first_line(const std::filesystem::path& path) {
  const std::string text = read_small_file(path);
  return text.substr(0, text.find('\n'));
}

// Returns the milliseconds and the relative MSE of a row.
std::pair<double, double> read_point(const measure::Table& table,
                                     const std::vector<std::string>& row) {
  return {std::atof(row[table.column("ms")].c_str()),
          std::atof(row[table.column("relative_mse")].c_str())};
}

}  // namespace

SweepTable::SweepTable(std::filesystem::path folder, const std::string& fingerprint,
                       std::vector<std::string> columns, std::size_t key_columns)
    : folder_(std::move(folder)), key_columns_(key_columns), table_{std::move(columns), {}} {
  program::require_writable_folder(folder_);
  const auto mark = folder_ / "scene.txt", csv = folder_ / "sweep.csv";
  if (std::filesystem::exists(mark) && first_line(mark) != fingerprint) {
    restarted_ = true;
    std::filesystem::remove(csv);
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      if (entry.path().filename().string().starts_with("reference-") &&
          entry.path().extension() == ".exr")
        std::filesystem::remove(entry.path());
  }
  AtomicFile file(mark);
  file.write(fingerprint + "\n");
  file.commit();
  if (!std::filesystem::exists(csv)) return;
  measure::Table earlier = measure::read_csv(csv);
  if (earlier.columns.size() > table_.columns.size() || earlier.columns.size() < key_columns_ ||
      !std::equal(earlier.columns.begin(), earlier.columns.end(), table_.columns.begin()))
    throw Error(csv.string(),
                "has other columns, of another version: remove it or choose another folder");
  for (auto& row : earlier.rows) row.resize(table_.columns.size());
  table_.rows = std::move(earlier.rows);
}

bool SweepTable::holds(const std::vector<std::string>& key) const {
  return std::any_of(table_.rows.begin(), table_.rows.end(), [&](const auto& row) {
    return std::equal(key.begin(), key.begin() + static_cast<std::ptrdiff_t>(key_columns_),
                      row.begin());
  });
}

void SweepTable::add(std::vector<std::string> row) {
  table_.rows.push_back(std::move(row));
  measure::write_csv(folder_ / "sweep.csv", table_);
}

void SweepTable::mark_front() {
  const std::size_t front = table_.column("front");
  std::map<std::vector<std::string>, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < table_.rows.size(); ++i) {
    std::vector<std::string> key;
    for (const char* name : {"view", "camera", "size", "device", "frames"})
      key.push_back(table_.rows[i][table_.column(name)]);
    groups[key].push_back(i);
  }
  for (const auto& [key, rows] : groups) {
    std::vector<std::pair<double, double>> points;
    for (const std::size_t row : rows) points.push_back(read_point(table_, table_.rows[row]));
    const std::vector<bool> marks = find_front(points);
    for (std::size_t i = 0; i < rows.size(); ++i)
      table_.rows[rows[i]][front] = marks[i] ? "yes" : "no";
  }
  measure::write_csv(folder_ / "sweep.csv", table_);
}

std::vector<bool> find_front(const std::vector<std::pair<double, double>>& points) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!std::isnan(points[i].first) && !std::isnan(points[i].second)) order.push_back(i);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return points[a] < points[b]; });
  std::vector<bool> on_front(points.size());
  // By rising cost, a point is on the front if its error is below that of all before it.
  const std::pair<double, double>* best = nullptr;
  for (const std::size_t i : order)
    if (!best || points[i].second < best->second || points[i] == *best) {
      on_front[i] = true;
      best = &points[i];
    }
  return on_front;
}

namespace {

nlohmann::ordered_json to_json_value(const std::string& column, const std::string& text) {
  if (text.empty() || text == "-") return nullptr;
  if (column == "front") return text == "yes";
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size() && std::isfinite(number))
    return number;
  return text;
}

}  // namespace

std::string to_json(const measure::Table& table) {
  auto rows = nlohmann::ordered_json::array();
  for (const auto& row : table.rows) {
    nlohmann::ordered_json object;
    for (std::size_t i = 0; i < row.size(); ++i)
      object[table.columns[i]] = to_json_value(table.columns[i], row[i]);
    rows.push_back(std::move(object));
  }
  return program::to_json_text(rows) + "\n";
}

measure::Plot make_sweep_plot(const measure::Table& table, const std::string& view) {
  measure::Plot plot{
      "Error against cost, view " + view, "ms a frame (GPU clock)", "relative MSE", {}};
  const auto cell = [&](const auto& row, const char* name) { return row[table.column(name)]; };
  measure::PlotSeries front{"Pareto front", {}};
  long max_frames = 0;
  for (const auto& row : table.rows)
    max_frames = std::max(max_frames, std::atol(cell(row, "frames").c_str()));
  plot.title += ", mean of " + std::to_string(max_frames) + " frames";
  for (const auto& row : table.rows) {
    if (cell(row, "view") != view || std::atol(cell(row, "frames").c_str()) != max_frames) continue;
    const std::string estimator = cell(row, "estimator");
    auto series = std::find_if(plot.series.begin(), plot.series.end(),
                               [&](const measure::PlotSeries& s) { return s.name == estimator; });
    if (series == plot.series.end()) series = plot.series.insert(series, {estimator, {}});
    std::string label;
    for (const render::Setting& setting : list_swept_settings())
      label +=
          std::string(setting.name) + " " + cell(row, render::column_of(setting).c_str()) + "  ";
    const auto [ms, error] = read_point(table, row);
    series->points.push_back({ms, error, label});
    if (cell(row, "front") == "yes") front.points.push_back(series->points.back());
  }
  if (!front.points.empty()) plot.series.push_back(std::move(front));
  for (measure::PlotSeries& series : plot.series)
    std::sort(series.points.begin(), series.points.end(),
              [](const auto& a, const auto& b) { return a.x < b.x; });
  return plot;
}

}  // namespace nightcity::experiments
