// Turns polygons so that shells face outward. Nothing is guessed: a shell is turned only where its
// polygons meet edge to edge everywhere, because then inside and outside are facts, or where the
// file says which of them are roofs and floors.
#pragma once

#include "tools/mesh/edges.h"
#include "tools/mesh/mesh_report.h"

namespace nightcity::mesh {

/// Returns whether every vertex is a place: finite, and within any frame.
bool has_finite_places(const city::CityObject& object);

/// Turns the polygons of every closed shell in `object` outward, and of shells with a gap where
/// most of their roofs face down and floors up, and counts them in report.turned. Shells with a gap
/// that name no roofs, those within another shell, and walls between parts stay as they are.
/// Coordinates in metres.
void orient_outward(city::CityObject& object, MeshReport& report);

/// The same over a table made by the caller.
void orient_along(city::CityObject& object, const EdgeTable& edges, MeshReport& report);

}  // namespace nightcity::mesh
