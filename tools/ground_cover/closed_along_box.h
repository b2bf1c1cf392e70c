// Closes lines that cross a box along its sides.
#pragma once

#include <array>
#include <vector>

#include "tools/ground_cover/box_index.h"
#include "tools/line.h"

namespace nightcity::ground_cover {

/// Returns the rings of the two halves into which lines part a box: an odd number of rings of one
/// half, and an even one of the other, goes round each place. Lines begin and end on sides of the
/// box. Without a line one half is empty, and the other is the box.
std::array<std::vector<Ring>, 2> close_along_box(const std::vector<Line>& lines, const Box& box);

}  // namespace nightcity::ground_cover
