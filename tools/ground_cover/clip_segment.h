// Cuts lines to rectangles.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tools/ground_cover/box_index.h"
#include "tools/line.h"

namespace nightcity::ground_cover {

/// Returns the part of a segment within a box as shares of its length (Liang, Barsky 1984); none
/// where they do not meet.
std::optional<std::pair<double, double>> clip_segment(const glm::dvec2& a, const glm::dvec2& b,
                                                      const Box& box);

/// Returns the parts of a line within a box. Ends that are not cut keep their bits.
std::vector<Line> clip_line(const Line& line, const Box& box);

/// Returns the length of the part of a line within a box, m.
double find_length_m(std::span<const glm::dvec2> line, const Box& box);

}  // namespace nightcity::ground_cover
