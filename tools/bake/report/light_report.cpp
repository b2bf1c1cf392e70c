#include "tools/bake/report/light_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

namespace nightcity {
namespace {

using nlohmann::json;

// One row a use: how many of its windows have light at each full hour.
std::string hours_in_words(const WindowReport& windows) {
  if (windows.placed == 0) return {};
  std::string text = fmt::format("{:<12}{:>8}", "% lit at", "windows");
  for (std::size_t hour = 0; hour < night_hours; ++hour)
    text += fmt::format("{:>4}", clock_hour(hour));
  text += "\n";
  const auto row = [&text](const std::string& name, const WindowReport::Use& use) {
    text += fmt::format("{:<12}{:>8}", name, use.placed);
    for (const std::size_t lit : use.lit)
      text +=
          fmt::format("{:>4.0f}", 100 * static_cast<double>(lit) / static_cast<double>(use.placed));
    text += "\n";
  };
  WindowReport::Use all;
  for (const auto& [name, use] : windows.by_use) {
    row(name, use);
    all.placed += use.placed;
    for (std::size_t hour = 0; hour < night_hours; ++hour) all.lit[hour] += use.lit[hour];
  }
  if (windows.by_use.size() > 1) row("all", all);
  return text;
}

template <class Part>
std::string counts_in_words(const Part& part) {
  std::string text;
  if (!part.dropped.empty()) text += report_line("", "dropped: " + in_words(part.dropped));
  for (const auto& [value, sources] : part.sources)
    text += report_line("", fmt::format("{} from {}", value, in_words(sources)));
  return text;
}

}  // namespace

LampReport report_of(const LampSet& set, std::size_t mapped) {
  LampReport report{mapped, set.lamps.size(), 0, set.dropped, set.notes, set.sources};
  for (const PlacedLamp& lamp : set.lamps) report.total_flux_lm += lamp.flux_lm;
  return report;
}

json to_json(const LampReport& lamps) {
  return {
      {"mapped", lamps.mapped},   {"placed", lamps.placed}, {"total_flux_lm", lamps.total_flux_lm},
      {"dropped", lamps.dropped}, {"notes", lamps.notes},   {"sources", lamps.sources}};
}

json to_json(const WindowReport& windows) {
  json by_use = json::object();
  for (const auto& [name, use] : windows.by_use) {
    by_use[name] = {{"placed", use.placed}, {"lit", json::object()}};
    for (std::size_t hour = 0; hour < night_hours; ++hour)
      by_use[name]["lit"][fmt::format("{:02}:00", clock_hour(hour))] = use.lit[hour];
  }
  return {{"placed", windows.placed},
          {"total_flux_lm", windows.flux_lm},
          {"dropped", windows.dropped},
          {"sources", windows.sources},
          {"by_use", by_use}};
}

std::string to_text(const LampReport& lamps) {
  std::string text =
      report_line("lamps", fmt::format("{} luminaires of {} mapped lamps, {:.0f} klm in all",
                                       lamps.placed, lamps.mapped, lamps.total_flux_lm / 1000)) +
      counts_in_words(lamps);
  if (!lamps.notes.empty()) text += report_line("", "notes: " + in_words(lamps.notes));
  return text;
}

std::string to_text(const WindowReport& windows) {
  return report_line("windows",
                     fmt::format("{} with light at some time of the night, {:.0f} klm in all",
                                 windows.placed, windows.flux_lm / 1000)) +
         counts_in_words(windows) + hours_in_words(windows);
}

std::string report_line(const char* name, const std::string& value) {
  return fmt::format("{:<12}{}\n", name, value);
}

std::string in_words(const std::map<std::string, std::size_t>& counts) {
  std::vector<std::pair<std::string, std::size_t>> sorted(counts.begin(), counts.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [name, count] : sorted)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
  return text.empty() ? "none" : text;
}

}  // namespace nightcity
