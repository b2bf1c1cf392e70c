// Reports the barriers of the map: how long they are, how much of them stands, and why the rest
// does not.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/barriers/find_barriers.h"

namespace nightcity::bake {

struct BarriersReport {
  barriers::BarrierReport found;
  std::size_t triangles = 0;
};

nlohmann::json to_json(const BarriersReport& report);
/// Returns "" where the map has no barrier.
std::string to_text(const BarriersReport& report);

}  // namespace nightcity::bake
