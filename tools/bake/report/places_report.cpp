#include "tools/bake/report/places_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tools/bake/report/report_text.h"

namespace nightcity::bake {

nlohmann::json to_json(const PlacesReport& report) {
  using nlohmann::json;
  return {{"degrees_error_m", report.degrees_error_m ? json(*report.degrees_error_m) : json()},
          {"why_no_degrees", report.why_no_degrees},
          {"names", report.names},
          {"other_names", report.other_names},
          {"streets", report.streets},
          {"points", report.points},
          {"bytes", report.bytes},
          {"left_out", report.left_out}};
}

std::string to_text(const PlacesReport& report) {
  const std::string degrees =
      report.degrees_error_m
          ? fmt::format("latitude and longitude within {:.4f} m", *report.degrees_error_m)
          : "no latitude and longitude: " + report.why_no_degrees;
  std::string text =
      report_line("places", fmt::format("{}; {} names of streets and squares and {} other names of "
                                        "these in {} points; {:.1f} kB in all",
                                        degrees, report.names, report.other_names, report.points,
                                        static_cast<double>(report.bytes) / 1e3));
  if (!report.left_out.empty())
    text += report_line("", "names left out: " + in_words(report.left_out));
  return text;
}

}  // namespace nightcity::bake
