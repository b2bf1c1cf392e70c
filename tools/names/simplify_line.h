// Leaves out points of a line that lie on it.
#pragma once

#include "tools/line.h"

namespace nightcity::names {

/// Returns the line without points that lie within `tolerance_m` of it (Douglas and Peucker 1973).
/// Its ends stay, and every thousandth point, so that time grows with the number of points alone.
Line simplify_line(const Line& line, double tolerance_m);

}  // namespace nightcity::names
