// Joins triangles of the ground into facets that are flat to a few centimetres, so that streets are
// not cut at every edge of a terrain that was made through the corners of houses.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/bake/scene/tile_store.h"
#include "tools/mesh/owner_finder.h"

namespace nightcity::bake {

/// A triangle's corner may lie so far above or below the plane of the facet that it joins, m.
constexpr double facet_tolerance_m = 0.02;

/// Returns facets as areas of the plan (x east, y north, in the tile's coordinates), labelled by
/// one of the triangles in each. Neighbours share two corners to the last bit, belong to one
/// feature and face up. Outlines keep every corner of the triangles.
mesh::PlaneLayer find_facets(const std::vector<TileStore::StoredTriangle>& triangles);

}  // namespace nightcity::bake
