// Levels of detail that the names of files state, since an OBJ itself states none.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nightcity::obj {

struct LevelInName {
  int level = 0;     // times ten: 22 is LoD2.2, 20 is LoD2
  std::string rest;  // of the name: alike in the files of one model in several levels
};

/// Returns what the name of an OBJ ("tile-LoD22-3D.obj", "lod1/tile.obj", also .gz) states; empty
/// where it states no level, or is none of an OBJ.
std::optional<LevelInName> find_level_in_name(std::string_view name);

/// Returns for each of the names whether its file is to be read: of those that differ in their
/// level alone the one of the highest level up to `max_lod`, else of the lowest above, is; and all
/// others are.
std::vector<bool> find_best_levels(const std::vector<std::string>& names, int max_lod);

}  // namespace nightcity::obj
