// Reports the steps of the map: how many there are, what stands, and why the rest does not.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/steps/find_steps.h"

namespace nightcity::bake {

struct FlightsReport {
  steps::StepsReport found;
  std::size_t triangles = 0;
};

nlohmann::json to_json(const FlightsReport& report);
/// Returns "" where the map has no steps.
std::string to_text(const FlightsReport& report);

}  // namespace nightcity::bake
