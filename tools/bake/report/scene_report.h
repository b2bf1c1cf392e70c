// The report about the city's surfaces in the scene.
#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace nightcity::bake {

struct SceneTilesReport {
  std::map<std::string, std::size_t> triangles;  // by material, as written
  std::map<std::string, std::size_t> left_out;   // triangles, by reason
  std::size_t colours = 0;                       // materials that the model itself names
  std::size_t draped = 0;  // triangles that were published without heights and put onto the ground
};

}  // namespace nightcity::bake
