// What came of a city's lamps and windows, in words and as JSON: the same for every command that lays them.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/lights/lamps.h"
#include "tools/lights/windows.h"

namespace nightcity {

struct LampReport {
  std::size_t mapped = 0, placed = 0;  // nodes in the OSM files; luminaires
  double total_flux_lm = 0;
  std::map<std::string, std::size_t> dropped;  // by reason
  std::map<std::string, std::size_t> notes;    // what was mended or could not be read
  std::map<std::string, std::map<std::string, std::size_t>> sources;  // value, source, count
};
LampReport report_of(const LampSet& set, std::size_t mapped);

nlohmann::json to_json(const LampReport& lamps);
nlohmann::json to_json(const WindowReport& windows);
std::string to_text(const LampReport& lamps);
/// With a row for each use: how many of its windows have light at each full hour.
std::string to_text(const WindowReport& windows);

/// A line of a report: its name, then the value.
std::string report_line(const char* name, const std::string& value);
/// "12 wall, 3 roof", the most frequent first; "none".
std::string in_words(const std::map<std::string, std::size_t>& counts);

}  // namespace nightcity
