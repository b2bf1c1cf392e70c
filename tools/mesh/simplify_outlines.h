// Straightens the outlines of an object within a tolerance.
#pragma once

#include <cstddef>

#include "tools/city/city_model.h"

namespace nightcity::mesh {

/// Leaves out vertices of an object's rings, and returns how many, such that none of them lies
/// farther than `tolerance_m` from the edge that replaces its two (Douglas and Peucker 1973, in
/// space). A vertex is left out of all its rings together, and only where all of them pass it
/// between the same two neighbours: surfaces that met still meet. Rings keep three vertices at
/// least. Coordinates: metres.
std::size_t simplify_outlines(city::CityObject& object, double tolerance_m);

}  // namespace nightcity::mesh
