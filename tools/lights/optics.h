// Luminaires for lamps whose make nobody wrote down: analytic distributions of the usual families.
#pragma once

#include "tools/lights/photometry.h"

namespace nightcity {

enum class Optic {
  street,     // full cut-off, long along the road, thrown over it
  central,    // full cut-off, long along the road, hung over its middle
  lantern,    // decorative post-top globe under a shade: some light goes up
  floodlight  // narrow beam round the axis
};

const char* name_of(Optic optic);

/// With C = 0 across the road, away from the post. Any scale: ProfileTable::add brings it to one lumen.
Photometry make_optic(Optic optic);

}  // namespace nightcity
