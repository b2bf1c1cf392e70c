// The ends of thick barriers, aslant where they meet a house or a carriageway aslant.
#pragma once

#include <functional>
#include <glm/vec2.hpp>

namespace nightcity::barriers {

/// By how much the sides of a barrier go on beyond an end of its middle line, m; negative: they end
/// before it. Left and right are as one looks out of the barrier at that end.
struct BarrierEnd {
  double left_m = 0, right_m = 0;
};

/// Returns how both sides of a barrier end where its middle line meets something: each where it
/// meets that itself. Sides that do not within an angle of 17 degrees end beside the middle line,
/// as those of a wall along a house. `outward`: unit. `max_back_m`: the length of the last segment.
BarrierEnd find_end(const glm::dvec2& end, const glm::dvec2& outward, double width_m,
                    double max_back_m, const std::function<bool(const glm::dvec2&)>& blocks);

}  // namespace nightcity::barriers
