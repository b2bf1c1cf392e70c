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
  return static_cast<int>(std::clamp(std::floor((coordinate - box_.low[axis]) / square_m_[axis]),
                                     0.0, double{side - 1}));
}

template <class Visit>
void LineGrid::for_each_square(const Box& box, const Visit& visit) const {
  for (int row = find_square(box.low.y, 1); row <= find_square(box.high.y, 1); ++row)
    for (int column = find_square(box.low.x, 0); column <= find_square(box.high.x, 0); ++column)
      visit(static_cast<std::size_t>(row * side + column));
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
      for_each_square({glm::min(from, to) - slack_m, glm::max(from, to) + slack_m},
                      [&](std::size_t square) { marked_.set(square); });
    }
  }
}

bool LineGrid::meets(const Box& box) const {
  bool found = false;
  for_each_square(box, [&](std::size_t square) { found = found || marked_.test(square); });
  return found;
}

}  // namespace nightcity::bake
