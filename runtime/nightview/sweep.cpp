#include "runtime/nightview/sweep.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>

#include "formats/atomic_file.h"
#include "formats/error.h"

namespace nightcity {
namespace {

// A knob that an estimator does not have stands at one value, so that equal settings are measured once.
KnobValues canonical(KnobValues values) {
  const std::string& estimator = values["estimator"];
  const auto unused = [&](std::initializer_list<const char*> knobs) {
    for (const char* knob : knobs) values[knob] = std::string(1, '-');  // "-": a warning of g++ 12
  };
  if (estimator == "paper")
    unused({"reach", "local-share", "wide-share", "uniform-share", "fleet-share",
            "visibility-reuse", "boost", "permute"});
  if (estimator == "ris")
    unused({"neighbours", "radius", "history", "reach", "visibility-reuse", "boost", "permute"});
  if (estimator == "traced") unused({"visibility-reuse"});
  if (values["neighbours"] == "0") unused({"radius", "boost"});
  if (values["history"] == "0") unused({"reach", "boost", "permute"});
  if (estimator == "reference")
    for (const Knob& knob : knobs())
      if (knob.name != std::string("estimator")) unused({knob.name});
  return values;
}

std::string first_line(const std::filesystem::path& path) {
  std::string line;
  std::ifstream file(path);
  std::getline(file, line);
  return line;
}

}  // namespace

std::vector<KnobValues> combinations(const std::map<std::string, std::string>& chosen) {
  std::vector<KnobValues> all{{}};
  for (const Knob& knob : knobs()) {
    const auto given = chosen.find(knob.name);
    const std::string list =
        given == chosen.end() || given->second.empty() ? knob.defaults : given->second;
    std::vector<KnobValues> longer;
    for (const KnobValues& so_far : all)
      for (const std::string& word : split_list(std::string("--") + knob.name, list)) {
        RenderSettings ignored;
        knob.set(ignored, knob, word);
        longer.push_back(so_far);
        longer.back()[knob.name] = word;
      }
    all = std::move(longer);
  }
  std::set<KnobValues> seen;
  std::vector<KnobValues> unique;
  for (KnobValues& values : all)
    if (const KnobValues once = canonical(values); seen.insert(once).second) unique.push_back(once);
  return unique;
}

RenderSettings settings_of(const KnobValues& values) {
  RenderSettings settings;
  settings.jitter = false;  // the error measured is that of light, not of edges
  for (const Knob& knob : knobs()) {
    const auto given = values.find(knob.name);
    if (given != values.end() && given->second != "-") knob.set(settings, knob, given->second);
  }
  return settings;
}

SweepTable::SweepTable(std::filesystem::path folder, const std::string& fingerprint,
                       std::vector<std::string> columns, std::size_t key_columns)
    : folder_(std::move(folder)), key_columns_(key_columns), table_{std::move(columns), {}} {
  std::error_code failed;
  std::filesystem::create_directories(folder_, failed);
  if (!std::filesystem::is_directory(folder_))
    throw Error(folder_.string(), "is not a folder that can be written to");
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
  Table before = read_csv(csv);
  if (before.columns != table_.columns)
    throw Error(csv.string(),
                "has other columns: made by another version; remove it or choose another folder");
  table_ = std::move(before);
}

bool SweepTable::holds(const std::vector<std::string>& key) const {
  return std::any_of(table_.rows.begin(), table_.rows.end(), [&](const auto& row) {
    return std::equal(key.begin(), key.begin() + static_cast<std::ptrdiff_t>(key_columns_),
                      row.begin());
  });
}

void SweepTable::add(std::vector<std::string> row) {
  table_.rows.push_back(std::move(row));
  write_csv(folder_ / "sweep.csv", table_);
}

Plot sweep_plot(const Table& table, const std::string& view) {
  Plot plot{"Error against cost, view " + view, "ms a frame (GPU clock)", "relative MSE", {}};
  const auto cell = [&](const auto& row, const char* name) { return row[table.column(name)]; };
  long most = 0;
  for (const auto& row : table.rows) most = std::max(most, std::atol(cell(row, "frames").c_str()));
  plot.title += ", mean of " + std::to_string(most) + " frames";
  for (const auto& row : table.rows) {
    if (cell(row, "view") != view || std::atol(cell(row, "frames").c_str()) != most) continue;
    const std::string estimator = cell(row, "estimator");
    auto series = std::find_if(plot.series.begin(), plot.series.end(),
                               [&](const PlotSeries& s) { return s.name == estimator; });
    if (series == plot.series.end()) series = plot.series.insert(series, {estimator, {}});
    std::string label;
    for (const Knob& knob : knobs())
      label += std::string(knob.name) + " " + cell(row, knob.name) + "  ";
    series->points.push_back(
        {std::atof(cell(row, "ms").c_str()), std::atof(cell(row, "relative_mse").c_str()), label});
  }
  for (PlotSeries& series : plot.series)
    std::sort(series.points.begin(), series.points.end(),
              [](const auto& a, const auto& b) { return a.x < b.x; });
  return plot;
}

}  // namespace nightcity
