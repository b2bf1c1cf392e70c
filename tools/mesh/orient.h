// Turns polygons so that shells face outward. Nothing is guessed: a shell is turned only where its
// polygons meet edge to edge everywhere, because then inside and outside are facts, or where the
// file says which of them are roofs and floors.
#pragma once

#include "tools/mesh/edges.h"
#include "tools/mesh/mesh_report.h"

namespace nightcity::mesh {

/// Returns whether every vertex is a place: finite, and within any frame.
bool has_finite_places(const city::CityObject& object);

/// Turns the polygons of every closed shell in `object` outward, and counts them in report.turned.
/// A shell with a gap is turned as a whole where its polygons face the same way, and most of its
/// roofs face down and of its floors up. Else it stays as it is, as do shells within another shell
/// and walls between parts. Coordinates in metres.
void orient_outward(city::CityObject& object, MeshReport& report);

/// The same over a table made by the caller.
void orient_along(city::CityObject& object, const EdgeTable& edges, MeshReport& report);

}  // namespace nightcity::mesh
