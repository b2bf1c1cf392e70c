#include "tools/bake/report/cover_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "tools/bake/report/report_text.h"
#include "tools/bake/scene/cover_ground.h"

namespace nightcity::bake {

namespace {

// Returns "120 tram in a street, 40 rail on ballast", the greatest first.
std::string amounts_in_words(const std::map<std::string, double>& amounts) {
  std::vector<std::pair<double, std::string>> sorted;
  for (const auto& [name, amount] : amounts) sorted.emplace_back(-amount, name);
  std::sort(sorted.begin(), sorted.end());
  std::string text;
  for (const auto& [amount, name] : sorted)
    text += fmt::format("{}{:.0f} {}", text.empty() ? "" : ", ", -amount, name);
  return text.empty() ? "none" : text;
}

template <class Number>
void add_all(const std::map<std::string, Number>& from, std::map<std::string, Number>& to) {
  for (const auto& [name, amount] : from) to[name] += amount;
}

}  // namespace

void CoverReport::add(const ground_cover::Cover& cover) {
  areas += cover.areas().size();
  rounded_corners += cover.rounded_corners;
  lowered_kerbs += cover.lowered_kerbs;
  add_all(cover.markings, markings);
  add_all(cover.left_out, left_out);
  add_all(cover.assumed, assumed);
  add_all(cover.tracks_m, tracks_m);
  add_all(cover.parking_m, parking_m);
  add_all(cover.left_out_m, left_out_m);
}

nlohmann::json to_json(const TreeReport& report) {
  return {{"trees", report.sources},
          {"left_out", report.left_out},
          {"assumed_sizes", report.assumed_sizes},
          {"odd_sizes", report.odd_sizes},
          {"surfaces", report.surfaces}};
}

std::string to_text(const TreeReport& report) {
  if (report.sources.empty() && report.left_out.empty() && report.surfaces.empty()) return {};
  std::string text =
      report_line("trees", fmt::format("{}; {} of a size that is assumed", in_words(report.sources),
                                       report.assumed_sizes));
  if (report.odd_sizes > 0)
    text += report_line(
        "", fmt::format("{} sizes of the model not used: no tree has them", report.odd_sizes));
  if (!report.surfaces.empty())
    text += report_line("", "surfaces of the model: " + in_words(report.surfaces));
  if (!report.left_out.empty()) text += report_line("", "left out: " + in_words(report.left_out));
  return text;
}

nlohmann::json to_json(const CoverReport& report, const SceneTilesReport& tiles) {
  return {{"source", "map"},
          {"areas", report.areas},
          {"area_m2", round_to_tenths(tiles.cover_m2)},
          {"bare_m2", round_to_tenths(tiles.bare_m2)},
          {"triangles_added", tiles.cover_triangles},
          {"tiles_left_bare", tiles.uncovered_tiles},
          {"rounded_corners", report.rounded_corners},
          {"lowered_kerbs", report.lowered_kerbs},
          {"markings", report.markings},
          {"tracks_m", round_to_tenths(report.tracks_m)},
          {"parking_m", round_to_tenths(report.parking_m)},
          {"left_out", report.left_out},
          {"left_out_m", round_to_tenths(report.left_out_m)},
          {"assumed", report.assumed}};
}

std::string to_text(const CoverReport& report, const SceneTilesReport& tiles) {
  if (report.areas == 0 && report.left_out.empty() && report.left_out_m.empty()) return {};
  std::string text = report_line(
      "ground", fmt::format("{} areas of the map, in m2: {}; {} triangles more", report.areas,
                            amounts_in_words(tiles.cover_m2), tiles.cover_triangles));
  if (!report.tracks_m.empty())
    text += report_line("", "tracks, in m: " + amounts_in_words(report.tracks_m));
  if (!report.parking_m.empty())
    text += report_line("", "parking lanes, in m: " + amounts_in_words(report.parking_m));
  if (!report.markings.empty()) text += report_line("", "painted: " + in_words(report.markings));
  if (report.rounded_corners > 0)
    text += report_line("", fmt::format("{} corners of junctions rounded", report.rounded_corners));
  if (report.lowered_kerbs > 0)
    text += report_line("", fmt::format("kerbs lowered at {} crossings", report.lowered_kerbs));
  if (!report.assumed.empty()) text += report_line("", "assumed: " + in_words(report.assumed));
  if (!report.left_out.empty()) text += report_line("", "left out: " + in_words(report.left_out));
  if (!report.left_out_m.empty())
    text += report_line("", "left out, in m: " + amounts_in_words(report.left_out_m));
  if (tiles.uncovered_tiles > 0)
    text += report_line(
        "", fmt::format("{} tiles bare: their outlines cross more than {} times a point",
                        tiles.uncovered_tiles, max_outline_crossings));
  return text;
}

}  // namespace nightcity::bake
