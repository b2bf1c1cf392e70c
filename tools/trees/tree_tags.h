// Reads from the tags of a tree, a row of trees or a wood what its trees are like.
#pragma once

#include <optional>

#include "tools/osm/osm_data.h"
#include "tools/trees/leaf_habit.h"

namespace nightcity::trees {

/// The known part of a tree's size; the rest is assumed.
struct KnownSize {
  std::optional<double> height_m, crown_m, trunk_m;
  LeafHabit habit;
  bool is_shrub = false;
};

/// Returns what `height`, `est_height` and `diameter_crown` say, and the habit by `leaf_cycle` and
/// `leaf_type`, else by the genus or the name that `species`, `taxon` or `genus` give in any
/// language, else by the older tags `wood` and `type`.
KnownSize read_tree_tags(const osm::OsmTags& tags);

}  // namespace nightcity::trees
