// Names surfaces that a file leaves unnamed.
#pragma once

#include "tools/city/city_model.h"

namespace nightcity::mesh {

/// Names the surfaces that a LoD1 block leaves unknown from their normals: roof, wall, ground,
/// outer ceiling. Buildings and bridges only; what the file names stays. Coordinates E, N, H in
/// metres.
void classify_unknown_surfaces(city::CityObject& object);

}  // namespace nightcity::mesh
