#include "tools/bake/scene/line_grid.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace nightcity::bake {

using ground_cover::Box;

LineGrid::LineGrid(const Box& box)
    : box_(box), square_m_(glm::max((box.high - box.low) / double{side}, 1e-3)) {}

int LineGrid::find_square(double coordinate, int axis) const {
  return static_cast<int>(
      std::clamp((coordinate - box_.low[axis]) / square_m_[axis], 0.0, double{side - 1}));
}

template <class Visit>
bool LineGrid::any_square(const Box& box, const Visit& visit) const {
  const int left = find_square(box.low.x, 0), right = find_square(box.high.x, 0),
            top = find_square(box.high.y, 1);
  for (int row = find_square(box.low.y, 1); row <= top; ++row)
    for (int column = left; column <= right; ++column)
      if (visit(static_cast<std::size_t>(row * side + column))) return true;
  return false;
}

void LineGrid::add_ring(const std::vector<glm::dvec2>& ring) {
  constexpr double slack_m = 0.01;  // a triangle's edge may run along a line
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    // In pieces no longer than a square, whose boxes hold little beside the line.
    const glm::dvec2 squares = glm::abs(b - a) / square_m_;
    const int pieces = 1 + static_cast<int>(std::min(std::max(squares.x, squares.y), 4.0 * side));
    for (int k = 0; k < pieces; ++k) {
      const glm::dvec2 from = glm::mix(a, b, double(k) / pieces),
                       to = glm::mix(a, b, double(k + 1) / pieces);
      any_square({glm::min(from, to) - slack_m, glm::max(from, to) + slack_m},
                 [&](std::size_t square) {
                   marked_.set(square);
                   return false;
                 });
    }
  }
}

bool LineGrid::meets(const Box& box) const {
  return any_square(box, [&](std::size_t square) { return marked_.test(square); });
}

}  // namespace nightcity::bake
