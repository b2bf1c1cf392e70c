// Joins the pieces of a street or of a coast.
#pragma once

#include <vector>

#include "tools/line.h"

namespace nightcity::ground_cover {

/// Returns longer lines: where exactly two lines end in one point, to the last bit, they become
/// one. The result is sorted, and depends on the order of `lines` in nothing.
std::vector<Line> join_lines(std::vector<Line> lines);

}  // namespace nightcity::ground_cover
