// Places where barriers do not stand: buildings, carriageways, openings, all beyond the ground.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "tools/barriers/measured_way.h"
#include "tools/ground_cover/cover.h"
#include "tools/place/site.h"

namespace nightcity::barriers {

/// Places are asked this far apart: half of what a person passes.
constexpr double step_m = 0.5;

/// The reasons why no barrier stands somewhere.
extern const char* const in_building;
extern const char* const on_carriageway;
extern const char* const beyond_ground;
extern const char* const opening;

/// A stretch of a segment, from its start, and why no barrier stands there; null where one can.
struct Stretch {
  double from_m, to_m;
  const char* obstacle;
};

/// The arguments must outlive it.
class Obstacles {
 public:
  Obstacles(const ground_cover::Cover& cover, const place::HeightAt& height_at,
            const place::InsideBuilding& inside)
      : cover_(cover), height_at_(height_at), inside_(inside) {}

  /// Returns why no barrier can stand at a place; null where one can.
  const char* find(const glm::dvec2& place) const;
  /// Returns whether a place is one that a barrier ends at with both of its sides.
  bool blocks(const glm::dvec2& place) const;
  /// Returns the stretches of a segment between two distances from its start, one after the other,
  /// their ends to a millimetre.
  std::vector<Stretch> find_stretches(const MeasuredWay& line, std::size_t segment, double from_m,
                                      double to_m) const;

 private:
  const ground_cover::Cover& cover_;
  const place::HeightAt& height_at_;
  const place::InsideBuilding& inside_;
};

}  // namespace nightcity::barriers
