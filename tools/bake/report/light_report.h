// Reports about a city's lamps and windows, in words and as JSON: the same for every command that
// places them.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/layout/layout.h"
#include "tools/lights/place_lamps.h"
#include "tools/lights/windows.h"

namespace nightcity::bake {

struct LampReport {
  std::size_t mapped = 0, placed = 0;  // nodes in the OSM files; luminaires
  double total_flux_lm = 0;
  std::map<std::string, std::size_t> left_out;  // by reason
  std::map<std::string, std::size_t> notes;     // what was repaired or could not be read
  std::map<std::string, std::map<std::string, std::size_t>> sources;  // value, source, count
};
/// `mapped`: how many lamps the map has.
LampReport to_report(const lights::LampSet& set, std::size_t mapped);

/// The static lights of a bake.
struct LightsReport {
  LampReport lamps;
  layout::LayoutReport layout;  // of lamps where the map has none
  lights::WindowReport windows;
  std::size_t schedules = 0;  // different ones in the light file
};

nlohmann::json to_json(const LampReport& lamps);
nlohmann::json to_json(const lights::WindowReport& windows);
std::string to_text(const LampReport& lamps);
/// The text has a row for each use of buildings: how many of its windows have light at each full
/// hour.
std::string to_text(const lights::WindowReport& windows);

}  // namespace nightcity::bake
