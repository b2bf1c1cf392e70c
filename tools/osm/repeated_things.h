// Things that a map has twice in one place, as imports and slips of mappers leave them.
#pragma once

#include <cstddef>

#include "tools/osm/osm_data.h"

namespace nightcity::osm {

/// Keeps one of all streets, tracks, watercourses, barriers, rows of trees and shining areas of one
/// kind and layer that run through the same places, and of the trees in one place: the one with the
/// most tags, of these the first. Returns how many it left out. Two equal streets would be lit, and
/// their crossings painted, as two.
std::size_t leave_out_repeated(OsmData& map);

}  // namespace nightcity::osm
