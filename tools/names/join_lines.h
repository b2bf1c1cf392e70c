// Joins the pieces of a street.
#pragma once

#include "tools/names/line.h"

namespace nightcity::names {

/// Returns longer lines: where exactly two lines end in one point, to the last bit, they become
/// one. The result is sorted, and depends on the order of `lines` in nothing.
std::vector<Line> join_lines(std::vector<Line> lines);

}  // namespace nightcity::names
