// Analytic light distributions of the usual families of luminaires, for lamps whose make is
// unknown.
#pragma once

#include "tools/lights/photometry.h"

namespace nightcity::lights {

enum class Optic {
  street,     // full cut-off, wide along the road, thrown across it from one side
  central,    // full cut-off, wide along the road, hung over its middle
  lantern,    // decorative post-top globe under a shade: some light goes up
  floodlight  // narrow beam round the axis
};

const char* name_of(Optic optic);

/// Returns the distribution with C = 0 across the road, away from the post. Its scale is arbitrary;
/// ProfileTable::add scales it to one lumen.
Photometry make_optic(Optic optic);

}  // namespace nightcity::lights
