// Lines of a map as areas of a width, by GEOS.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <span>
#include <vector>

#include "tools/ground_cover/box_index.h"

namespace nightcity::ground_cover {

/// Makes areas of lines. One thread uses a Widener at a time.
class Widener {
 public:
  Widener();
  ~Widener();
  Widener(const Widener&) = delete;
  Widener& operator=(const Widener&) = delete;

  /// The sides of a line that its area lies on, seen in its direction.
  enum class Side { both, left, right };
  /// The shape of an area at the ends of its line.
  enum class Ends { round, flat };

  /// Returns the rings of all places within `distance_m` of the line (GEOS, buffer): mitred at its
  /// bends, and at its ends round or flat; always flat where it lies on one side only. Coordinates
  /// and distance in metres. Empty where the line has no two different finite points or GEOS finds
  /// no area.
  std::vector<Ring> widen(std::span<const glm::dvec2> line, double distance_m,
                          Side side = Side::both, Ends ends = Ends::round);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nightcity::ground_cover
