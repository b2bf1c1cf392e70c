#include "tools/bake/report/steps_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tools/bake/report/report_text.h"

namespace nightcity::bake {

nlohmann::json to_json(const FlightsReport& report) {
  const steps::StepsReport& found = report.found;
  return {{"source", "map"},
          {"ways", found.ways},
          {"flights", found.flights},
          {"steps", found.treads},
          {"counted_ways", found.counted_ways},
          {"mapped_m", round_to_tenths(found.mapped_m)},
          {"built_m", round_to_tenths(found.built_m)},
          {"left_out_m", round_to_tenths(found.left_out_m)},
          {"assumed", found.assumed},
          {"triangles", report.triangles}};
}

std::string to_text(const FlightsReport& report) {
  const steps::StepsReport& found = report.found;
  if (found.ways == 0) return {};
  std::string text = report_line(
      "steps", fmt::format("of the map: {} ways, {:.0f} of {:.0f} m in {} flights with {} steps, "
                           "{} ways by step_count, {} triangles",
                           found.ways, found.built_m, found.mapped_m, found.flights, found.treads,
                           found.counted_ways, report.triangles));
  if (!found.assumed.empty()) text += report_line("", "assumed: " + in_words(found.assumed));
  std::string left_out;
  for (const auto& [reason, m] : found.left_out_m)
    left_out += fmt::format("{}{:.0f} m {}", left_out.empty() ? "" : ", ", m, reason);
  if (!left_out.empty()) text += report_line("", "left out: " + left_out);
  return text;
}

}  // namespace nightcity::bake
