// Places between two nodes of a map, on the line that is straight in the city's frame.
#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "tools/place/longitude.h"
#include "tools/place/site.h"

namespace nightcity::place {

/// Returns longitude and latitude, degrees, of the place at a share of the straight line that leads
/// from `a` to `b` in the frame. A straight line of degrees is a curve there: at 69 degrees north
/// it lies 36 m beside one of 24 km.
inline glm::dvec2 find_between(const glm::dvec2& a, const glm::dvec2& b, double share,
                               const LonLatToFrame& to_frame) {
  if (!(share > 0)) return a;
  if (!(share < 1)) return b;
  const auto cross = [](const glm::dvec2& p, const glm::dvec2& q) { return p.x * q.y - p.y * q.x; };
  const glm::dvec2 wanted = glm::mix(to_frame(a), to_frame(b), share);
  glm::dvec2 place = glm::mix(a, {count_on(b.x, a.x), b.y}, share);
  constexpr double near_m = 1e-6, step = 1e-5;  // degrees
  constexpr int rounds = 8;                     // of Newton's method; two or three are enough
  for (int round = 0; round < rounds; ++round) {
    const glm::dvec2 here = to_frame(place), off = wanted - here;
    if (!(glm::length(off) > near_m)) break;
    const glm::dvec2 east = (to_frame(place + glm::dvec2(step, 0)) - here) / step,
                     north = (to_frame(place + glm::dvec2(0, step)) - here) / step;
    const double whole = cross(east, north);
    const glm::dvec2 by = glm::dvec2(cross(off, north), cross(east, off)) / whole;
    if (!(glm::length(by) < 1)) break;  // the frame ends here
    place += by;
  }
  return {count_on(place.x, 0), place.y};
}

}  // namespace nightcity::place
