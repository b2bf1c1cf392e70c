// Reports about a city's lamps and windows, in words and as JSON: the same for every command that
// places them.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/bake/city/city.h"
#include "tools/inventory/read_inventory.h"
#include "tools/layout/layout.h"
#include "tools/lights/place_lamps.h"
#include "tools/lights/windows.h"
#include "tools/map_lights/place_map_lights.h"

namespace nightcity::bake {

struct LampReport {
  std::size_t mapped = 0, placed = 0;  // lamps of maps and inventories; luminaires
  double total_flux_lm = 0;
  std::map<std::string, std::size_t> left_out;  // by reason
  std::map<std::string, std::size_t> notes;     // what was repaired or could not be read
  std::map<std::string, std::map<std::string, std::size_t>> sources;  // value, source, count
  std::vector<inventory::InventoryReport> inventories;
  std::string dark;  // why no lamp shines, and what would change that; "" = some do
};
/// Returns the report on the lamps of a city.
LampReport to_report(const lights::LampSet& set, const City& city);

/// The static lights of a bake.
struct LightsReport {
  LampReport lamps;
  layout::LayoutReport layout;  // of lamps where the map has none
  map_lights::MapLightReport map_lights;
  lights::WindowReport windows;
  std::size_t schedules = 0;  // different ones in the light file
};

/// Returns why the city has no lamp and which file would change that; "" where it has some.
std::string explain_darkness(const City& city, const LightsReport& lights);

nlohmann::json to_json(const LampReport& lamps);
nlohmann::json to_json(const lights::WindowReport& windows);
nlohmann::json to_json(const map_lights::MapLightReport& lights);
std::string to_text(const LampReport& lamps);
/// Returns "" where the map has nothing of the kind.
std::string to_text(const map_lights::MapLightReport& lights);
/// The text has a row for each use of buildings: how many of its windows have light at each full
/// hour.
std::string to_text(const lights::WindowReport& windows);

}  // namespace nightcity::bake
