#include "tools/trees/tree_tags.h"

#include <array>
#include <string>
#include <string_view>

#include "tools/osm/tag_values.h"

namespace nightcity::trees {
namespace {

std::optional<LeafHabit> find_named_habit(const osm::OsmTags& tags) {
  // A species says more than a genus, and a scientific name more than a common one.
  for (const char* key : {"species", "taxon", "taxon:species", "genus", "taxon:genus"})
    if (const auto habit = find_leaf_habit(osm::find_raw_tag(tags, key))) return habit;
  for (const std::string_view key : {"species:", "taxon:", "genus:"})
    for (auto tag = tags.lower_bound(std::string(key));
         tag != tags.end() && tag->first.starts_with(key); ++tag)
      if (const auto habit = find_leaf_habit(tag->second)) return habit;
  // OSM wiki, "Key:wood" and "Tag:natural=tree": older tags for the habit.
  for (const char* key : {"wood", "type"}) {
    const std::string value = osm::find_tag(tags, key);
    if (value == "evergreen") return LeafHabit{false, true};
    if (value == "palm") return LeafHabit{false, true};
    if (const auto habit = find_leaf_habit(value)) return habit;
  }
  return std::nullopt;
}

// Tags of leaves come before what the species says of them.
LeafHabit read_habit(const osm::OsmTags& tags) {
  const std::string type = osm::find_tag(tags, "leaf_type"),
                    cycle = osm::find_tag(tags, "leaf_cycle");
  LeafHabit habit;
  const auto named = find_named_habit(tags);
  if (named && type.empty()) habit = *named;
  if (type == "needleleaved") habit = {true, !named || named->evergreen};
  if (type == "broadleaved" && named) habit = {false, named->evergreen && !named->needles};
  if (type == "palm") habit = {false, true};
  if (!cycle.empty()) habit.evergreen = cycle == "evergreen" || cycle == "semi_evergreen";
  return habit;
}

}  // namespace

KnownSize read_tree_tags(const osm::OsmTags& tags) {
  KnownSize known;
  known.height_m = osm::find_length_m(tags, {"height", "est_height"}, 1, 100);
  known.crown_m = osm::find_length_m(tags, {"diameter_crown"}, 0.5, 40);
  known.habit = read_habit(tags);
  return known;
}

}  // namespace nightcity::trees
