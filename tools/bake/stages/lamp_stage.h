// The street lamps of a city: those that the map has, and laid-out ones where it has streets only.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/bake/city/city.h"
#include "tools/layout/layout.h"
#include "tools/lights/lamp_hours.h"
#include "tools/lights/lamps.h"

namespace nightcity {

/// A measured luminaire and the lamps that get it.
struct LuminaireFile {
  std::filesystem::path file;         // IES LM-63 or EULUMDAT
  std::vector<std::string> highways;  // OSM classes of road; empty: every road
  std::vector<LampType> types;        // empty: every type
  bool take_flux = true;              // false: the lumens stay those of the table of defaults
};

struct LampStageOptions {
  layout::LayoutOptions layout;
  LampHours hours;
  std::vector<LuminaireFile> luminaires;  // the first that serves a lamp is taken

  bool lays_out() const { return layout.mode != layout::LayoutOptions::Mode::never; }
};

struct CityLamps {
  LampSet set;
  layout::LayoutReport layout;
};

/// Places the lamps on the city's ground. Without a city model a lamp stands at the height of its
/// tag `ele`, else at 0. Throws Error when a luminaire cannot be read, or when the map has lamps or
/// streets to be lit and the city no CRS.
CityLamps place_city_lamps(const City& city, const LampStageOptions& options);

}  // namespace nightcity
