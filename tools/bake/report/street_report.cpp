#include "tools/bake/report/street_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tools/bake/report/report_text.h"

namespace nightcity::bake {

nlohmann::json to_json(const StreetReport& report) {
  return {{"surfaces", report.surfaces},
          {"polygons_left_out", report.left_out},
          {"km", report.km},
          {"km_classed_by_code", report.km_by_code},
          {"junctions", report.junctions},
          {"ends", report.ends}};
}

std::string to_text(const StreetReport& report) {
  if (report.surfaces == 0) return {};
  double sum = 0;
  std::string classes;
  for (const auto& [highway, km] : report.km) {
    sum += km;
    classes += fmt::format("{}{} {:.1f}", classes.empty() ? "" : ", ", highway, km);
  }
  return report_line(
      "streets",
      fmt::format("{:.1f} km in the middle of {} road surfaces of the model: {} "
                  "({:.1f} km by code, else by width); {} junctions, {} ends",
                  sum, report.surfaces, classes, report.km_by_code, report.junctions, report.ends));
}

}  // namespace nightcity::bake
