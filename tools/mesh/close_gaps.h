// Closes what is open in a building's shell where it can be shown what belongs there. There are two
// such cases:
//
// * Cracks: vertices that were meant to be one and were rounded apart. Moved together, by at most a
//   centimetre, they leave no open edge. If the gap were meant, moving its sides together would not
//   close the shell.
// * The floor: the open edges of a shell are one level ring at its lowest height. Such a house was
//   published without its ground surface, which CityGML allows. A missing wall or roof may be meant
//   (an open garage, a canopy) and stays open.
#pragma once

#include "tools/mesh/edges.h"
#include "tools/mesh/mesh_report.h"

namespace nightcity::mesh {

/// Closes the shells of `object` where it can be shown what belongs there, then turns them outward
/// as orient_outward does; counted in `report`. Coordinates E, N, H in metres.
void repair_shells(city::CityObject& object, MeshReport& report);

/// Closes gaps alone, over a table made by the caller. Returns true where the object has changed,
/// so that the table no longer fits.
bool close_gaps_along(city::CityObject& object, const EdgeTable& edges, MeshReport& report);

}  // namespace nightcity::mesh
