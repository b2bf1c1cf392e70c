// Reports where the colours of buildings come from.
#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace nightcity::bake {

/// Numbers of buildings. One whose walls have a colour of their own here and none there counts with
/// the table; so do roofs.
struct SkinReport {
  std::map<std::string, std::size_t> walls, roofs;  // by "table", "model" or "map"
  std::map<std::string, std::size_t> ages;          // of those with a skin from the table
};

nlohmann::json to_json(const SkinReport& report);
/// Returns "" where no building has a skin from the table.
std::string to_text(const SkinReport& report);

}  // namespace nightcity::bake
