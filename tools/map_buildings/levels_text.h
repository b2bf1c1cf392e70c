// Counts of levels as people write them in tags of buildings.
#pragma once

#include <optional>
#include <string_view>

namespace nightcity::map_buildings {

struct Levels {
  double count = 0;
  bool is_whole = true;  // false: words stand behind the number that say something else
};

/// Returns levels from "5", "2.5", "~3", "4 floors", the middle of "3-4", the most of "10;12", and
/// one more than the number in "G+4", "R+4" or "P+4": in India, France and on the Balkans levels
/// are counted above that on the ground. None where there is no number.
std::optional<Levels> parse_levels(std::string_view text);

}  // namespace nightcity::map_buildings
