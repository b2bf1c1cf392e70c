// The trees of a map: single ones, rows, and those of woods.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "tools/ground_cover/cover.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"
#include "tools/trees/tree.h"

namespace nightcity::trees {

/// Distance of trees in a row and in woods where the map does not show each, m.
constexpr double row_spacing_m = 8, wood_spacing_m = 7;
/// More trees are left out, and counted: a map's woods have millions.
constexpr std::size_t max_trees = 200'000;

struct TreeSet {
  std::vector<Tree> trees;
  std::map<std::string, std::size_t> sources;   // "mapped", "in rows", "in woods"
  std::map<std::string, std::size_t> left_out;  // by reason
  std::size_t assumed_sizes = 0;                // trees whose height or crown no tag gives
};

/// Finds the trees that stand on the ground, within `bounds` (E, N, m), and in no building.
/// `cover`: woods are its woodland, as far as nothing else lies there. Sizes are the tags `height`
/// and `diameter_crown`; one of them gives the other, and without both a tree is 10 m high
/// (needle-leaved 14 m) and its crown 0.6 of that wide, which is a guess.
TreeSet find_trees(const osm::OsmData& map, const ground_cover::Cover& cover,
                   const ground_cover::Box& bounds, const place::LonLatToFrame& to_frame,
                   const place::HeightAt& height_at, const place::InsideBuilding& inside);

}  // namespace nightcity::trees
