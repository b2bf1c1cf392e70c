// The report about laid-out lamps and the illuminance that they give, as JSON and in words.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/layout/layout.h"

namespace nightcity::bake {

/// Returns counts and classes; with `streets` also a row for each stretch.
nlohmann::json to_json(const layout::LayoutReport& report, bool streets);

/// Returns a table with a row for each class of road; with `streets` also for each stretch. ""
/// where no lamp was laid out.
std::string to_text(const layout::LayoutReport& report, bool streets);

}  // namespace nightcity::bake
