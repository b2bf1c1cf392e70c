// Tells apart streets of one name.
#pragma once

#include "tools/line.h"

namespace nightcity::names {

/// Lines in two squares of this side that touch belong together: those nearer than half the side
/// always, those farther apart than 2.83 times the side only by others between them.
constexpr double apart_m = 500;

/// Returns the lines in groups that lie apart from each other; lines and groups stay in order.
std::vector<std::vector<Line>> group_lines_apart(const std::vector<Line>& lines);

}  // namespace nightcity::names
