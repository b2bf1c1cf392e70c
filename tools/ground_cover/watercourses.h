// The rivers, streams and canals that a map draws as lines.
#pragma once

#include <span>

#include "tools/ground_cover/cover.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"

namespace nightcity::ground_cover {

/// Adds watercourses to `cover` as water of the width that `width` or `est_width` says, else of the
/// one that is usual for the kind of `waterway`, as far as they lie in `bounds` (E, N, m): over
/// land, and under streets and squares. Those that run below the ground or on a bridge, or are dry
/// at times, are left out, and counted in metres. Coastlines are the sea's (sea.h).
void add_watercourses(std::span<const osm::OsmWay> lines, const place::LonLatToFrame& to_frame,
                      const Box& bounds, Cover& cover);

}  // namespace nightcity::ground_cover
