// The streets that were found in the city model's own roads.
#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace nightcity::bake {

struct StreetReport {
  std::size_t surfaces = 0;
  std::map<std::string, std::size_t> left_out;  // polygons, by reason
  std::map<std::string, double> km;             // by highway
  double km_by_code = 0;
  std::size_t junctions = 0, ends = 0;
};

nlohmann::json to_json(const StreetReport& report);
/// Returns "" where the model has no roads.
std::string to_text(const StreetReport& report);

}  // namespace nightcity::bake
