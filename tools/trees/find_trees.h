// The trees of a city: those of its model, and of its map single ones, rows and woods.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "tools/ground_cover/cover.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"
#include "tools/trees/model_tree.h"
#include "tools/trees/tree.h"

namespace nightcity::trees {

/// Distance of trees in a row and in woods where the map does not show each, m.
constexpr double row_spacing_m = 8, wood_spacing_m = 7;
/// A tree of the map as near as this to one of the model is the same tree, m: an assumption, half
/// of the distance in a row.
constexpr double same_tree_m = 4;
/// A tree of the model stands on the ground where that is within so much of its foot, m: an
/// assumption. Elsewhere, as on roofs, it stands where the model says.
constexpr double max_lift_m = 3;
/// A trunk's diameter where no attribute says, in heights of its tree: an assumption.
constexpr double trunk_of_height = 0.03;
/// More trees are left out, and counted: a map's woods have millions.
constexpr std::size_t max_trees = 200'000;

struct TreeSet {
  std::vector<Tree> trees;
  std::map<std::string, std::size_t> sources;   // "of the model", "mapped", ...
  std::map<std::string, std::size_t> left_out;  // by reason
  std::size_t assumed_sizes = 0;                // trees of which neither height nor crown is known
  std::size_t odd_sizes = 0;                    // that the model gives and no tree has
};

/// Finds the trees that stand on the ground, within `bounds` (E, N, m), and in no building.
/// `cover`: woods are its woodland, as far as nothing else lies there. Sizes are the tags `height`
/// and `diameter_crown`; one of them gives the other, and without both a tree is 10 m high
/// (needle-leaved 14 m) and its crown 0.6 of that wide, which is a guess.
/// `model`: trees of the city model. They come first and stand wherever the model says; trees of
/// the map that are the same or would stand within the distance of others are left out.
TreeSet find_trees(const osm::OsmData& map, const ground_cover::Cover& cover,
                   const ground_cover::Box& bounds, const place::LonLatToFrame& to_frame,
                   const place::HeightAt& height_at, const place::InsideBuilding& inside,
                   std::span<const ModelTree> model = {});

}  // namespace nightcity::trees
