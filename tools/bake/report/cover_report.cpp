#include "tools/bake/report/cover_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "tools/bake/report/report_text.h"

namespace nightcity::bake {

nlohmann::json to_json(const TreeReport& report) {
  return {{"source", "map"},
          {"trees", report.sources},
          {"left_out", report.left_out},
          {"assumed_sizes", report.assumed_sizes}};
}

std::string to_text(const TreeReport& report) {
  if (report.sources.empty() && report.left_out.empty()) return {};
  std::string text =
      report_line("trees", fmt::format("{}; {} of a size that is assumed", in_words(report.sources),
                                       report.assumed_sizes));
  if (!report.left_out.empty()) text += report_line("", "left out: " + in_words(report.left_out));
  return text;
}

nlohmann::json to_json(const CoverReport& report, const SceneTilesReport& tiles) {
  nlohmann::json area_m2 = nlohmann::json::object();
  for (const auto& [name, m2] : tiles.cover_m2) area_m2[name] = std::round(10 * m2) / 10;
  return {{"source", "map"},
          {"areas", report.areas},
          {"area_m2", area_m2},
          {"bare_m2", std::round(10 * tiles.bare_m2) / 10},
          {"triangles_added", tiles.cover_triangles},
          {"tiles_left_bare", tiles.uncovered_tiles},
          {"markings", report.markings},
          {"left_out", report.left_out},
          {"assumed", report.assumed}};
}

std::string to_text(const CoverReport& report, const SceneTilesReport& tiles) {
  if (report.areas == 0 && report.left_out.empty()) return {};
  std::vector<std::pair<double, std::string>> kinds;
  for (const auto& [name, m2] : tiles.cover_m2) kinds.emplace_back(-m2, name);
  std::sort(kinds.begin(), kinds.end());
  std::string text;
  for (const auto& [m2, name] : kinds)
    text += fmt::format("{}{:.0f} {}", text.empty() ? "" : ", ", -m2, name);
  text = report_line("ground",
                     fmt::format("{} areas of the map, in m2: {}; {} triangles more", report.areas,
                                 text.empty() ? "none" : text, tiles.cover_triangles));
  if (!report.markings.empty()) text += report_line("", "painted: " + in_words(report.markings));
  if (!report.assumed.empty()) text += report_line("", "assumed: " + in_words(report.assumed));
  if (!report.left_out.empty()) text += report_line("", "left out: " + in_words(report.left_out));
  if (tiles.uncovered_tiles > 0)
    text += report_line(
        "", fmt::format("{} tiles bare: their outlines cross too often", tiles.uncovered_tiles));
  return text;
}

}  // namespace nightcity::bake
