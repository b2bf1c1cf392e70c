// Says what files of other kinds are by their names, where their bytes do not.
#pragma once

#include <array>
#include <string_view>

namespace nightcity::city {

/// Returns what a file without a mark at its beginning is named as, with the remedy; "" where its
/// name says nothing.
inline std::string_view explain_by_name(std::string_view name) {
  struct NamedAs {
    std::array<std::string_view, 6> endings;
    std::string_view words;
  };
  constexpr std::array table{
      NamedAs{{".asc", ".xyz", ".hgt", ".flt", ".bil", ".dem"},
              "is named as a raster of heights: these belong in [terrain] dem"},
      NamedAs{{".csv", ".tsv"},
              "is named as a table: one of lamps belongs in [[lamps.inventories]]"},
      NamedAs{
          {".stl", ".off"},
          "is named as a mesh without a format's mark: export it as Wavefront OBJ (Blender does)"},
      NamedAs{{".dgn", ".dwg"}, "is named as a drawing: export it as CityGML or Wavefront OBJ"},
      NamedAs{{".sql", ".dump", ".backup"},
              "is named as a dump of a database: restore it, and export CityGML from it"},
      NamedAs{{".skp", ".3ds", ".max", ".c4d", ".3dm", ".rvt"},
              "is named as a file of a modelling program: export it as Wavefront OBJ or CityGML"}};
  for (const NamedAs& row : table)
    for (const std::string_view ending : row.endings)
      if (!ending.empty() && name.ends_with(ending)) return row.words;
  return {};
}

}  // namespace nightcity::city
