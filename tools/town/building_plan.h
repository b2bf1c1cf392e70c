// The houses of a block as plans: footprints, roofs and attributes, before they become surfaces.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/town/hills.h"
#include "tools/town/street_plan.h"

namespace nightcity::town {

enum class Shape {
  /// Outline of 4, edge 0 on the street; edges 0 and 2 parallel.
  quad,
  /// Outline of 6: an L with its outer corner at 1 and its inner corner at 4; wings equally deep.
  corner,
  /// Outline of 4 around a hole of 4 with sides parallel to it, equally deep on every side.
  courtyard,
  /// Outline of n; edge 0 stands against another wall and carries the apex of a half cone.
  apse
};

enum class Roof { flat, shed, gabled, hipped, pyramid, mansard };

struct BuildingPlan {
  Shape shape = Shape::quad;
  Roof roof = Roof::gabled;
  std::vector<glm::dvec2> outline;  // counter-clockwise, m from the town's origin
  std::vector<glm::dvec2> hole;     // counter-clockwise, corner for corner with the outline
  double ground_m = 0, eave_m = 0, ridge_m = 0;  // absolute heights
  int storeys = 1;
  int year = 1900;
  const char* function = "31001_1010";  // ALKIS building function code
  std::vector<BuildingPlan> parts;      // a church's tower and apse: BuildingParts beside this body
};

/// Returns every building of block (i, j), in a fixed order. None leaves the parcel, and they touch
/// each other only along shared (party) walls.
std::vector<BuildingPlan> plan_block(const StreetPlan& streets, const Hills& hills,
                                     std::uint64_t seed, int i, int j);

}  // namespace nightcity::town
