#include "tools/bake/report/layout_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tools/bake/report/report_text.h"
#include "tools/lights/lighting_class.h"

namespace nightcity::bake {
namespace {

using nlohmann::json;

json row(const layout::RoadClassReport& sum) {
  return {{"class", sum.wanted},
          {"wanted_maintained_lx", sum.wanted_lx},
          {"km", sum.length_m / 1000},
          {"stretches", sum.streets},
          {"lamps", sum.lamps},
          {"average_lx", sum.average_lx},
          {"median_least_lx", sum.min_lx},
          {"median_uniformity", sum.uniformity},
          {"share_in_class", sum.in_class}};
}

json row(const layout::StreetReport& street) {
  return {{"highway", street.highway},
          {"name", street.name},
          {"ways", street.ways},
          {"class", street.wanted},
          {"arrangement", layout::name_of(street.arrangement)},
          {"length_m", street.length_m},
          {"width_m", street.width_m},
          {"mounting_m", street.mounting_m},
          {"spacing_m", street.spacing_m},
          {"flux_lm", street.flux_lm},
          {"lamps", street.lamps},
          {"average_lx", street.field.average_lx},
          {"min_lx", street.field.min_lx},
          {"uniformity", street.field.uniformity()}};
}

}  // namespace

json to_json(const layout::LayoutReport& report, bool streets) {
  json result = {{"lamps", report.lamps},
                 {"maintenance_factor", lights::maintenance_factor},
                 {"arrangements", report.arrangements},
                 {"left_out", report.left_out},
                 {"notes", report.notes},
                 {"unlit_ways", report.unlit_ways},
                 {"classes", json::object()}};
  for (const auto& [highway, sum] : report.classes) result["classes"][highway] = row(sum);
  if (!streets) return result;
  result["streets"] = json::array();
  for (const layout::StreetReport& street : report.streets)
    result["streets"].push_back(row(street));
  return result;
}

std::string to_text(const layout::LayoutReport& report, bool streets) {
  if (report.streets.empty() && report.unlit_ways.empty()) return {};
  std::string text = fmt::format("{} lamps laid out", report.lamps);
  if (!report.arrangements.empty()) text += ": " + in_words(report.arrangements);
  text += "\n";
  if (!report.left_out.empty()) text += "left out: " + in_words(report.left_out) + "\n";
  if (!report.notes.empty()) text += "notes: " + in_words(report.notes) + "\n";
  if (!report.unlit_ways.empty()) text += "ways not lit: " + in_words(report.unlit_ways) + "\n";
  if (report.classes.empty()) return text;
  text +=
      fmt::format("{:<14}{:>6}{:>7}{:>8}{:>7}{:>7}{:>9}{:>8}{:>8}{:>7}{:>10}\n", "road", "class",
                  "lx", "km", "lamps", "per km", "Eav lx", "x 0.8", "Emin lx", "Uo", "in class");
  for (const auto& [highway, sum] : report.classes)
    text += fmt::format(
        "{:<14}{:>6}{:>7.1f}{:>8.2f}{:>7}{:>7.0f}{:>9.2f}{:>8.2f}{:>8.2f}{:>7.2f}{:>9.0f}%\n",
        highway, sum.wanted, sum.wanted_lx, sum.length_m / 1000, sum.lamps,
        static_cast<double>(sum.lamps) / (sum.length_m / 1000), sum.average_lx,
        sum.average_lx * lights::maintenance_factor, sum.min_lx, sum.uniformity,
        100 * sum.in_class);
  text +=
      "Eav is over all of a class; Emin and Uo are medians of its stretches; in class is the share "
      "of the "
      "length whose\n"
      "Eav x 0.8 (maintained) lies between the class's value and 1.5 times it.\n";
  if (!streets) return text;
  text += fmt::format("\n{:<14}{:>6}{:>9}{:>8}{:>7}{:>7}{:>9}{:>8}{:>8}{:>7}  {:<13} {}\n", "road",
                      "class", "length m", "width m", "lamps", "lm", "Eav lx", "x 0.8", "Emin lx",
                      "Uo", "arrangement", "name and ways");
  for (const layout::StreetReport& street : report.streets) {
    std::string ways;
    for (const std::int64_t way : street.ways) ways += fmt::format(" {}", way);
    text += fmt::format(
        "{:<14}{:>6}{:>9.0f}{:>8.1f}{:>7}{:>7.0f}{:>9.2f}{:>8.2f}{:>8.2f}{:>7.2f}  {:<13} {}{}\n",
        street.highway, street.wanted, street.length_m, street.width_m, street.lamps,
        street.flux_lm, street.field.average_lx,
        street.field.average_lx * lights::maintenance_factor, street.field.min_lx,
        street.field.uniformity(), layout::name_of(street.arrangement), street.name, ways);
  }
  return text;
}

}  // namespace nightcity::bake
