#include "tools/bake/report/light_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tools/bake/report/report_text.h"

namespace nightcity::bake {
namespace {

using nlohmann::json;

// Returns one row a use: how many of its windows have light at each full hour.
std::string hours_in_words(const lights::WindowReport& windows) {
  if (windows.placed == 0) return {};
  std::string text = fmt::format("{:<12}{:>8}", "% lit at", "windows");
  for (std::size_t hour = 0; hour < lights::night_hours; ++hour)
    text += fmt::format("{:>4}", lights::clock_hour(hour));
  text += "\n";
  const auto row = [&text](const std::string& name, const lights::WindowReport::Use& use) {
    text += fmt::format("{:<12}{:>8}", name, use.placed);
    for (const std::size_t lit : use.lit)
      text +=
          fmt::format("{:>4.0f}", 100 * static_cast<double>(lit) / static_cast<double>(use.placed));
    text += "\n";
  };
  lights::WindowReport::Use all;
  for (const auto& [name, use] : windows.by_use) {
    row(name, use);
    all.placed += use.placed;
    for (std::size_t hour = 0; hour < lights::night_hours; ++hour) all.lit[hour] += use.lit[hour];
  }
  if (windows.by_use.size() > 1) row("all", all);
  return text;
}

using Counts = std::map<std::string, std::size_t>;

std::string counts_in_words(const Counts& left_out, const std::map<std::string, Counts>& sources) {
  std::string text;
  if (!left_out.empty()) text += report_line("", "left out: " + in_words(left_out));
  for (const auto& [value, counts] : sources)
    text += report_line("", fmt::format("{} from {}", value, in_words(counts)));
  return text;
}

}  // namespace

LampReport to_report(const lights::LampSet& set, std::size_t mapped) {
  LampReport report{mapped, set.lamps.size(), 0, set.left_out, set.notes, set.sources};
  for (const lights::PlacedLamp& lamp : set.lamps) report.total_flux_lm += lamp.flux_lm;
  return report;
}

json to_json(const LampReport& lamps) {
  return {
      {"mapped", lamps.mapped},    {"placed", lamps.placed}, {"total_flux_lm", lamps.total_flux_lm},
      {"dropped", lamps.left_out}, {"notes", lamps.notes},   {"sources", lamps.sources}};
}

json to_json(const lights::WindowReport& windows) {
  json by_use = json::object();
  for (const auto& [name, use] : windows.by_use) {
    by_use[name] = {{"placed", use.placed}, {"lit", json::object()}};
    for (std::size_t hour = 0; hour < lights::night_hours; ++hour)
      by_use[name]["lit"][fmt::format("{:02}:00", lights::clock_hour(hour))] = use.lit[hour];
  }
  return {{"placed", windows.placed},
          {"total_flux_lm", windows.flux_lm},
          {"dropped", windows.left_out},
          {"sources", windows.sources},
          {"by_use", by_use}};
}

std::string to_text(const LampReport& lamps) {
  std::string text =
      report_line("lamps", fmt::format("{} luminaires of {} mapped lamps, {:.0f} klm in all",
                                       lamps.placed, lamps.mapped, lamps.total_flux_lm / 1000)) +
      counts_in_words(lamps.left_out, lamps.sources);
  if (!lamps.notes.empty()) text += report_line("", "notes: " + in_words(lamps.notes));
  return text;
}

std::string to_text(const lights::WindowReport& windows) {
  return report_line("windows",
                     fmt::format("{} with light at some time of the night, {:.0f} klm in all",
                                 windows.placed, windows.flux_lm / 1000)) +
         counts_in_words(windows.left_out, windows.sources) + hours_in_words(windows);
}

}  // namespace nightcity::bake
