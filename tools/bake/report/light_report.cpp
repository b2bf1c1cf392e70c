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

json to_json(const inventory::InventoryReport& report) {
  json made{{"file", report.file},       {"format", report.format},  {"rows", report.rows},
            {"lamps", report.lamps},     {"joined", report.joined},  {"replaced", report.replaced},
            {"skipped", report.skipped}, {"columns", report.columns}};
  if (report.titles > 0) made["lines_above_headings"] = report.titles;
  if (!report.encoding.empty()) made["encoding"] = report.encoding;
  if (!report.incomplete.empty()) made["incomplete"] = report.incomplete;
  if (!report.doubt.empty()) made["doubt"] = report.doubt;
  return made;
}

std::string to_text(const inventory::InventoryReport& report) {
  std::string text = fmt::format("{} ({}): {} rows, {} posts", report.file, report.format,
                                 report.rows, report.lamps);
  if (report.titles > 0)
    text += fmt::format(", {} lines above its headings passed over", report.titles);
  if (!report.encoding.empty()) text += ", read as " + report.encoding;
  if (report.joined > 0) text += fmt::format(", {} rows at the place of another", report.joined);
  if (report.replaced > 0)
    text += fmt::format(", in place of {} lamps of the map", report.replaced);
  if (!report.columns.empty()) text += "; rows with " + in_words(report.columns);
  if (!report.skipped.empty()) text += "; skipped: rows " + in_words(report.skipped);
  if (!report.incomplete.empty()) text += "; incomplete: " + report.incomplete;
  if (!report.doubt.empty()) text += "; doubt: " + report.doubt;
  return text;
}

}  // namespace

LampReport to_report(const lights::LampSet& set, const City& city) {
  LampReport report{city.map().lamps.size(),
                    set.lamps.size(),
                    0,
                    set.left_out,
                    set.notes,
                    set.sources,
                    city.inventories(),
                    {}};
  for (const lights::PlacedLamp& lamp : set.lamps) report.total_flux_lm += lamp.flux_lm;
  return report;
}

std::string explain_darkness(const City& city, const LightsReport& lights) {
  if (lights.lamps.placed + lights.layout.lamps > 0) return {};
  const std::string remedy =
      "a map of the place in [osm] files, or an inventory in [[lamps.inventories]], would change "
      "that";
  if (!city.frame().has_lon_lat())
    return "the city names no CRS, so that no map can be laid under it: [city] crs, and " + remedy;
  const CityInputs& inputs = city.inputs();
  if (inputs.maps.empty() && inputs.inventories.empty())
    return (city.map().highways.empty()
                ? "there is neither a map nor an inventory, and the model has no roads: "
                : "the model's roads get no lamps, and there is neither a map nor an inventory: ") +
           remedy;
  if (city.map().lamps.empty() && city.map().highways.empty())
    return "the map has neither lamps nor streets: one that has them would change that";
  return "nothing that the map knows is lit within the model: one that covers it would change that";
}

json to_json(const LampReport& lamps) {
  json inventories = json::array();
  for (const inventory::InventoryReport& report : lamps.inventories)
    inventories.push_back(to_json(report));
  return {{"mapped", lamps.mapped},
          {"placed", lamps.placed},
          {"total_flux_lm", lamps.total_flux_lm},
          {"dropped", lamps.left_out},
          {"notes", lamps.notes},
          {"sources", lamps.sources},
          {"inventories", inventories},
          {"dark", lamps.dark}};
}

json to_json(const map_lights::MapLightReport& lights) {
  json kinds = json::object();
  for (std::size_t n = 0; n < lights.kinds.size(); ++n) {
    const map_lights::MapLightReport::Kind& kind = lights.kinds[n];
    json& row = kinds[name_of(static_cast<map_lights::MapLightKind>(n))];
    row = {{"mapped", kind.mapped},
           {"lit", kind.lit},
           {"lights", kind.lights},
           {"total_flux_lm", kind.flux_lm},
           {"shining", json::object()}};
    for (std::size_t hour = 0; hour < lights::night_hours; ++hour)
      row["shining"][fmt::format("{:02}:00", lights::clock_hour(hour))] = kind.hours[hour];
  }
  return {{"kinds", kinds},
          {"dropped", lights.left_out},
          {"notes", lights.notes},
          {"sources", lights.sources}};
}

json to_json(const lights::WindowReport& windows) {
  json by_use = json::object();
  for (const auto& [name, use] : windows.by_use) {
    by_use[name] = {{"placed", use.placed}, {"lit", json::object()}};
    for (std::size_t hour = 0; hour < lights::night_hours; ++hour)
      by_use[name]["lit"][fmt::format("{:02}:00", lights::clock_hour(hour))] = use.lit[hour];
  }
  return {{"placed", windows.placed},         {"emitters", windows.emitters},
          {"total_flux_lm", windows.flux_lm}, {"dropped", windows.left_out},
          {"sources", windows.sources},       {"by_use", by_use}};
}

std::string to_text(const LampReport& lamps) {
  std::string text =
      report_line("lamps", fmt::format("{} luminaires of {} mapped lamps, {:.0f} klm in all",
                                       lamps.placed, lamps.mapped, lamps.total_flux_lm / 1000));
  if (!lamps.dark.empty()) text += report_line("", "no lamp shines: " + lamps.dark);
  for (const inventory::InventoryReport& report : lamps.inventories)
    text += report_line("", to_text(report));
  text += counts_in_words(lamps.left_out, lamps.sources);
  if (!lamps.notes.empty()) text += report_line("", "notes: " + in_words(lamps.notes));
  return text;
}

std::string to_text(const map_lights::MapLightReport& lights) {
  std::string text;
  for (std::size_t n = 0; n < lights.kinds.size(); ++n) {
    const map_lights::MapLightReport::Kind& kind = lights.kinds[n];
    if (kind.mapped == 0) continue;
    constexpr std::size_t at_22 = 5, at_2 = 9;
    text += report_line(
        text.empty() ? "map lights" : "",
        fmt::format("{}: {} of {} lit, {} lights, {:.0f} klm; {} shine at 22:00, {} at 2:00",
                    name_of(static_cast<map_lights::MapLightKind>(n)), kind.lit, kind.mapped,
                    kind.lights, kind.flux_lm / 1000, kind.hours[at_22], kind.hours[at_2]));
  }
  if (text.empty()) return text;
  text += counts_in_words(lights.left_out, lights.sources);
  if (!lights.notes.empty()) text += report_line("", "notes: " + in_words(lights.notes));
  return text;
}

std::string to_text(const lights::WindowReport& windows) {
  return report_line("windows",
                     fmt::format("{} with light at some time of the night, {:.0f} klm in all",
                                 windows.placed, windows.flux_lm / 1000)) +
         (windows.emitters < windows.placed
              ? report_line("", fmt::format("grouped into {} emitters", windows.emitters))
              : "") +
         counts_in_words(windows.left_out, windows.sources) + hours_in_words(windows);
}

}  // namespace nightcity::bake
