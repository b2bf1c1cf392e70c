// Latitudes, longitudes and names of streets that a scene holds.
#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace nightcity::bake {

struct PlacesReport {
  std::optional<double> degrees_error_m;  // nothing: the scene has no latitude and longitude
  std::string why_no_degrees;             // "" where it has them
  std::size_t names = 0, streets = 0, points = 0;
  std::size_t other_names = 0;                  // of the streets, by which they are found, too
  std::size_t bytes = 0;                        // in city.glb, degrees and names together
  std::map<std::string, std::size_t> left_out;  // named things of the map, by reason
};

nlohmann::json to_json(const PlacesReport& report);
std::string to_text(const PlacesReport& report);

}  // namespace nightcity::bake
