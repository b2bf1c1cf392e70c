// What a layout has reached, as JSON and in words.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/layout/layout.h"

namespace nightcity {

/// Counts and classes; with `streets` a row for each stretch too.
nlohmann::json to_json(const layout::LayoutReport& report, bool streets);

/// A table with a row for each class of road; with `streets` for each stretch too. "" where nothing was laid
/// out.
std::string to_text(const layout::LayoutReport& report, bool streets);

}  // namespace nightcity
