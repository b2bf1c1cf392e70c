// The report of the traffic, in words and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/traffic/traffic.h"

namespace nightcity::bake {

nlohmann::json to_json(const traffic::TrafficReport& report);
std::string to_text(const traffic::TrafficReport& report);

}  // namespace nightcity::bake
