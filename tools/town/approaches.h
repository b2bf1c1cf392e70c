// The ends of streets at junctions: crossings, signals, signs to give way.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "tools/town/roads.h"

namespace nightcity::town {

/// Stretches have no more approaches than this.
constexpr int max_approaches = 4;

/// A place of a stretch near a junction: people cross it there, or its vehicles wait.
struct Approach {
  enum class Kind { zebra, crossing_at_signals, unmarked_crossing, signals, give_way };
  Kind kind;
  glm::dvec2 at;  // in the middle of the stretch, m from the town's origin
  bool at_end;    // of the stretch: vehicles come to it from the stretch's start
  int number;     // among those of the stretch: 0 to max_approaches - 1
};

/// Returns whether vehicles drive on a street.
bool is_driven(StreetClass street);

/// Returns the approaches of a stretch in the order in which they lie along it. Where two streets
/// meet that are secondary or more there are signals; main streets have zebra crossings at every
/// second junction, and others give way to them.
std::vector<Approach> find_approaches(const StreetPlan& streets, const Stretch& stretch,
                                      std::uint64_t seed);

}  // namespace nightcity::town
