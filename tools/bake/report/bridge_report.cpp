#include "tools/bake/report/bridge_report.h"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tools/bake/report/report_text.h"

namespace nightcity::bake {
namespace {

using LengthCounts = std::map<std::string, bridges::BridgeReport::Count>;

nlohmann::json to_json(const LengthCounts& counts) {
  nlohmann::json result = nlohmann::json::object();
  for (const auto& [name, count] : counts)
    result[name] = {{"bridges", count.bridges}, {"length_m", round_to_tenths(count.length_m)}};
  return result;
}

std::string lengths_in_words(const LengthCounts& counts) {
  std::string text;
  for (const auto& [name, count] : counts)
    text += fmt::format("{}{} {} ({:.0f} m)", text.empty() ? "" : ", ", count.bridges, name,
                        count.length_m);
  return text.empty() ? "none" : text;
}

}  // namespace

nlohmann::json to_json(const BridgesReport& report) {
  return {{"source", "map"},
          {"built", to_json(report.found.built)},
          {"on_the_ground", to_json(report.found.on_ground)},
          {"lower_than_wanted", report.found.low},
          {"deck_m2", round_to_tenths(report.deck_m2)},
          {"piers", report.piers},
          {"triangles", report.triangles},
          {"bare_decks", report.bare_decks}};
}

std::string to_text(const BridgesReport& report) {
  if (report.found.built.empty() && report.found.on_ground.empty()) return {};
  std::string text = report_line(
      "bridges", fmt::format("of the map, of {}; {:.0f} m2 of decks, {} piers, {} triangles",
                             lengths_in_words(report.found.built), report.deck_m2, report.piers,
                             report.triangles));
  if (report.found.low > 0)
    text += report_line(
        "", fmt::format("{} lower above what they cross than is usual: the way up is too short",
                        report.found.low));
  if (!report.found.on_ground.empty())
    text += report_line("", "on the ground: " + lengths_in_words(report.found.on_ground));
  if (report.bare_decks > 0)
    text += report_line(
        "", fmt::format("{} decks bare: their outlines cross too often", report.bare_decks));
  return text;
}

}  // namespace nightcity::bake
