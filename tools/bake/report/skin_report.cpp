#include "tools/bake/report/skin_report.h"

#include <nlohmann/json.hpp>

#include "tools/bake/report/report_text.h"

namespace nightcity::bake {

nlohmann::json to_json(const SkinReport& report) {
  return {{"walls", report.walls}, {"roofs", report.roofs}, {"built", report.ages}};
}

std::string to_text(const SkinReport& report) {
  if (report.ages.empty()) return {};
  return report_line("skins", "walls of buildings by " + in_words(report.walls)) +
         report_line("", "roofs by " + in_words(report.roofs)) +
         report_line("", "built: " + in_words(report.ages));
}

}  // namespace nightcity::bake
