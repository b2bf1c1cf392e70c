// The transformation by which files place a shared shape.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <optional>

namespace nightcity::city {

/// Returns the transformation whose 16 numbers stand in rows; nothing where they are no such. The
/// last number divides the others (homogeneous coordinates), and 0 stands for 1. Where a
/// translation stands in the last row, and none in the last column, the matrix was written in
/// columns.
std::optional<glm::dmat4> make_placement(const std::array<double, 16>& rows);

}  // namespace nightcity::city
