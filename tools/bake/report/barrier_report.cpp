#include "tools/bake/report/barrier_report.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "tools/bake/report/report_text.h"

namespace nightcity::bake {
namespace {

std::map<std::string, std::size_t> to_metres(const std::map<std::string, double>& lengths_m) {
  std::map<std::string, std::size_t> whole;
  for (const auto& [name, m] : lengths_m)
    if (m < 1e15) whole[name + " (m)"] = static_cast<std::size_t>(std::llround(m));
  return whole;
}

}  // namespace

nlohmann::json to_json(const BarriersReport& report) {
  nlohmann::json kinds = nlohmann::json::object();
  for (const auto& [name, kind] : report.found.kinds)
    kinds[name] = {{"ways", kind.ways},
                   {"mapped_m", round_to_tenths(kind.mapped_m)},
                   {"built_m", round_to_tenths(kind.built_m)}};
  return {{"source", "map"},
          {"kinds", kinds},
          {"left_out_m", round_to_tenths(report.found.left_out_m)},
          {"assumed", report.found.assumed},
          {"openings", report.found.openings},
          {"areas", report.found.areas},
          {"triangles", report.triangles}};
}

std::string to_text(const BarriersReport& report) {
  if (report.found.kinds.empty()) return {};
  std::string text;
  for (const auto& [name, kind] : report.found.kinds)
    text += fmt::format("{}{} {:.0f} of {:.0f}", text.empty() ? "" : ", ", name, kind.built_m,
                        kind.mapped_m);
  text = report_line("barriers", fmt::format("of the map, in m: {}; {} openings, {} triangles",
                                             text, report.found.openings, report.triangles));
  if (!report.found.assumed.empty())
    text += report_line("", "assumed: " + in_words(report.found.assumed));
  if (!report.found.left_out_m.empty())
    text += report_line("", "left out: " + in_words(to_metres(report.found.left_out_m)));
  return text;
}

}  // namespace nightcity::bake
