#include "tools/bake/recipe/lamp_keys.h"

#include "tools/lights/lamp_defaults.h"
#include "tools/lights/lamp_tags.h"
#include "tools/lights/lighting_class.h"

namespace nightcity::recipe {
namespace {

void check_road(const Setting& setting, const std::string& highway) {
  const auto road = road_defaults(highway);
  if (!road || road->highway != highway)
    setting.refuse("names no class of road that may have lamps");
}

layout::LayoutOptions::Mode layout_mode(const Setting& setting) {
  using Mode = layout::LayoutOptions::Mode;
  const std::string name = setting.text();
  if (name == "auto") return Mode::automatic;
  if (name == "never") return Mode::never;
  if (name == "always") return Mode::always;
  setting.refuse("is none of \"auto\", \"never\" and \"always\"");
}

std::map<std::string, std::string> lighting_classes(const Setting& setting) {
  const toml::table* rows = setting.node.as_table();
  if (!rows) setting.refuse("is not a table like {residential = \"P4\"}");
  std::map<std::string, std::string> result;
  for (const auto& [key, node] : *rows) {
    const std::string highway(key.str());
    const Setting row{setting.file, setting.name + "." + highway, node};
    check_road(row, highway);
    if (!lighting_class(row.text()))
      row.refuse("is no lighting class of EN 13201-2: P1 to P6, C0 to C5, M1 to M6");
    result[highway] = row.text();
  }
  return result;
}

std::map<std::string, NightSpan> night_spans(const Setting& setting) {
  const toml::table* rows = setting.node.as_table();
  if (!rows) setting.refuse("is not a table like {residential = \"23:00-05:00\"}");
  std::map<std::string, NightSpan> result;
  for (const auto& [key, node] : *rows) {
    const std::string highway(key.str());
    const Setting row{setting.file, setting.name + "." + highway, node};
    check_road(row, highway);
    const auto span = parse_night_span(row.text());
    if (!span) row.refuse("is no span of the night like \"23:00-05:00\", between 17:00 and 07:00");
    result[highway] = *span;
  }
  return result;
}

Recipe::Lamps::LuminaireFile luminaire_file(const Setting& setting,
                                            const std::filesystem::path& folder) {
  const toml::table* keys = setting.node.as_table();
  if (!keys)
    setting.refuse(
        "is not a list of tables like {file = \"street.ldt\", roads = [\"residential\"]}");
  Recipe::Lamps::LuminaireFile result;
  for (const auto& [key, node] : *keys) {
    const std::string name(key.str());
    const Setting value{setting.file, setting.name + "." + name, node};
    if (name == "file") {
      result.file = (folder / value.text()).lexically_normal();
    } else if (name == "roads") {
      for (const std::string& road : value.texts()) {
        check_road(value, road);
        result.highways.push_back(road);
      }
    } else if (name == "types") {
      for (const std::string& type : value.texts()) {
        const auto known = parse_lamp_type(type);
        if (!known) value.refuse("holds no type of lamp: \"" + type + "\"");
        result.types.push_back(*known);
      }
    } else if (name == "flux") {
      result.take_flux = value.boolean();
    } else {
      value.refuse("is none of file, roads, types and flux");
    }
  }
  if (result.file.empty()) setting.refuse("names no file");
  return result;
}

std::vector<Recipe::Lamps::LuminaireFile> luminaire_files(const Setting& setting,
                                                          const std::filesystem::path& folder) {
  const toml::array* rows = setting.node.as_array();
  if (!rows)
    setting.refuse(
        "is not a list of tables like {file = \"street.ldt\", roads = [\"residential\"]}");
  std::vector<Recipe::Lamps::LuminaireFile> result;
  for (const toml::node& row : *rows)
    result.push_back(luminaire_file({setting.file, setting.name, row}, folder));
  return result;
}

}  // namespace

Table lamp_settings(Recipe::Lamps& lamps, const std::filesystem::path& folder) {
  return {
      {"layout", [&lamps](const Setting& s) { lamps.layout.mode = layout_mode(s); }},
      {"class", [&lamps](const Setting& s) { lamps.layout.class_of = lighting_classes(s); }},
      {"off", [&lamps](const Setting& s) { lamps.hours.off = night_spans(s); }},
      {"half_night", [&lamps](const Setting& s) { lamps.hours.half_night = night_spans(s); }},
      {"luminaires",
       [&lamps, folder](const Setting& s) { lamps.luminaires = luminaire_files(s, folder); }},
  };
}

}  // namespace nightcity::recipe
