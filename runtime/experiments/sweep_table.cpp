#include "runtime/experiments/sweep_table.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/input_file.h"
#include "formats/program/output.h"
#include "runtime/experiments/sweep_points.h"

namespace nightcity::experiments {
namespace {

std::string first_line(const std::filesystem::path& path) {
  std::string line;
  refuse_special_file(path);
  std::ifstream file(path);
  std::getline(file, line);
  return line;
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
      if (entry.path().filename().string().starts_with("reference-"))
        std::filesystem::remove(entry.path());
  }
  AtomicFile file(mark);
  file.write(fingerprint + "\n");
  file.commit();
  if (!std::filesystem::exists(csv)) return;
  measure::Table earlier = measure::read_csv(csv);
  if (earlier.columns != table_.columns)
    throw Error(csv.string(),
                "has other columns, of another version: remove it or choose another folder");
  table_ = std::move(earlier);
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

measure::Plot make_sweep_plot(const measure::Table& table, const std::string& view) {
  measure::Plot plot{
      "Error against cost, view " + view, "ms a frame (GPU clock)", "relative MSE", {}};
  const auto cell = [&](const auto& row, const char* name) { return row[table.column(name)]; };
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
    series->points.push_back(
        {std::atof(cell(row, "ms").c_str()), std::atof(cell(row, "relative_mse").c_str()), label});
  }
  for (measure::PlotSeries& series : plot.series)
    std::sort(series.points.begin(), series.points.end(),
              [](const auto& a, const auto& b) { return a.x < b.x; });
  return plot;
}

}  // namespace nightcity::experiments
