// Options that decide how the lamps of a city are made.
#pragma once

#include <compare>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/inventory/inventory.h"
#include "tools/layout/layout.h"
#include "tools/lights/lamp_defaults.h"
#include "tools/lights/lamp_hours.h"

namespace nightcity::bake {

/// A measured luminaire and the lamps that get it.
struct LuminaireFile {
  std::filesystem::path file;           // IES LM-63, EULUMDAT, TM-33 or GLDF
  std::vector<std::string> highways;    // OSM classes of road; empty: every road
  std::vector<lights::LampType> types;  // empty: every type
  std::vector<std::string> models{};    // as an inventory names them; empty: every one
  bool take_flux = true;                // false: the lumens stay those of the table of defaults

  auto operator<=>(const LuminaireFile&) const = default;
};

struct LampStageOptions {
  layout::LayoutOptions layout;
  lights::LampHours hours;
  std::vector<LuminaireFile> luminaires;  // the first that serves a lamp is taken
  std::vector<inventory::InventoryFile> inventories;
  double merge_m = 0;  // the distance up to which a lamp takes in weaker ones; 0: each stays

  bool lays_out() const { return layout.mode != layout::LayoutOptions::Mode::never; }
};

}  // namespace nightcity::bake
