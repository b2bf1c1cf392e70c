// Tells from a tree's species what its leaves are like.
#pragma once

#include <optional>
#include <string_view>

namespace nightcity::trees {

struct LeafHabit {
  bool needles = false, evergreen = false;
};

/// Returns the habit of a species by its scientific name, of which the genus comes first ("Pinus
/// sylvestris"), or by words for it ("coniferous"). None where neither says anything; a genus that
/// is not in the table may be any.
std::optional<LeafHabit> find_leaf_habit(std::string_view species);

}  // namespace nightcity::trees
