// Inventories of street lamps as towns publish them: a table with a place in each row.
#pragma once

#include <array>
#include <compare>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "formats/error.h"

namespace nightcity::inventory {

/// Thrown where no driver takes a file as a table.
struct NoTable : Error {
  using Error::Error;
};

/// A property that a column can hold, and the tag by which the rest of the program knows it
/// (tools/lights/lamp_tags.h reads the values).
struct Property {
  std::string_view name;  // in a recipe: "lumens"
  std::string_view tag;   // "light:lumens"
  std::string_view help;
};
constexpr std::array properties{
    Property{"height", "height", "mounting height, in `height_unit` or with its unit"},
    Property{"lumens", "light:lumens", "luminous flux of one luminaire, lm"},
    Property{"watts", "light:power", "power of one luminaire, W"},
    Property{"kelvin", "light:colour_temperature", "colour temperature, K"},
    Property{"type", "lamp_type", "kind of lamp, as OSM's `lamp_type`, or HPS, LED, MH, ..."},
    Property{"mount", "lamp_mount", "what it hangs on, as OSM's `lamp_mount`"},
    Property{"direction", "light:direction", "where it shines, degrees from north or NNE"},
    Property{"count", "light:count", "luminaires on the post"},
    Property{"state", "operational_status", "whether it works, as OSM's `operational_status`"},
    Property{"hours", "lit", "when it is lit, as OSM's `lit`"},
    Property{"model", "luminaire_model", "the luminaire, for `models` of `[lamps] luminaires`"},
};

/// Returns the property of that name; null where there is none.
constexpr const Property* find_property(std::string_view name) {
  for (const Property& property : properties)
    if (property.name == name) return &property;
  return nullptr;
}

/// One file and how its columns are understood.
struct InventoryFile {
  std::filesystem::path file;
  std::string layer;  // "": the only one
  std::string crs;    // in place of the one the file names; "": that
  std::string x, y;   // columns of a table without geometry; "": common names
  std::string id;     // column that tells rows apart; "": their number
  std::map<std::string, std::string> columns;  // by property
  /// By property: texts of the file and the words to put in their place.
  std::map<std::string, std::map<std::string, std::string>> values;
  bool feet = false;    // heights without a unit are in feet
  double within_m = 5;  // a map's lamp as near as this to one of the inventory is the same lamp
  int max_lamps = 2'000'000;  // a limit: more rows end the bake
  std::string licence;

  auto operator<=>(const InventoryFile&) const = default;
};

}  // namespace nightcity::inventory
