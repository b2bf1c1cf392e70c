// Checks that hold for every table of lamps, broken or not: for the fuzz target and the test of its
// corpus.
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>

#include "formats/error.h"
#include "tools/inventory/degrees_text.h"
#include "tools/inventory/read_inventory.h"

namespace nightcity::test {

/// Returns a name for a file of these bytes, whose ending decides how a table is read.
inline const char* name_table(std::string_view bytes) {
  struct Kind {
    std::string_view start;
    const char* name;
  };
  constexpr std::array<Kind, 9> kinds{{{"PK\x03\x04", "lamps.zip"},
                                       {"\x1f\x8b", "lamps.gz"},
                                       {"{\"type\"", "lamps.geojson"},
                                       {"{", "lamps.json"},
                                       {"[", "lamps.json"},
                                       {"/", "lamps.json"},
                                       {"var ", "lamps.json"},
                                       {"lamps(", "lamps.json"},
                                       {"\t", "lamps.txt"}}};
  for (const Kind& kind : kinds)
    if (bytes.starts_with(kind.start)) return kind.name;
  const std::string_view line = bytes.substr(0, bytes.find('\n'));
  return line.find('\t') == line.npos ? "lamps.csv" : "lamps.tsv";
}

/// Returns what is wrong with how the text of one cell is read as a place; "" where it is sound.
inline std::string find_fault_of_cell(std::string_view text) {
  using namespace inventory;
  if (const auto angle = parse_angle(text); angle && !std::isfinite(angle->degrees)) return "angle";
  if (const auto place = parse_lat_lon(text);
      place && !(std::isfinite(place->x) && std::isfinite(place->y)))
    return "place";
  return "";
}

/// Returns what is wrong with how the table is read; "" where it is sound, or refused with a
/// reason.
inline std::string find_fault_of_inventory(const std::filesystem::path& path) {
  inventory::InventoryFile file;
  file.file = path;
  file.max_lamps = 1000;
  if (path.extension() != ".geojson") file.crs = "EPSG:4326";  // others name none
  try {
    const inventory::Inventory read = inventory::read_inventory(file);
    for (const osm::OsmLampNode& lamp : read.lamps)
      if (!(std::abs(lamp.lon_lat.x) <= 180 && std::abs(lamp.lon_lat.y) <= 90)) return "place";
    if (read.lamps.size() > static_cast<std::size_t>(file.max_lamps)) return "more than the limit";
    if (!read.lamps.empty() && read.report.rows == 0) return "lamps without a row";
  } catch (const Error& error) {
    if (std::string(error.what()).empty()) return "an error without words";
  }
  return "";
}

}  // namespace nightcity::test
