// Roofs that fall to all sides: pyramids, and those over four corners.
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <utility>

#include "tools/map_buildings/centroid.h"
#include "tools/map_buildings/roof_shapes.h"

namespace nightcity::map_buildings {
namespace {

using Corners = std::array<glm::dvec2, 4>;  // anticlockwise; the first side is a long one

std::optional<Corners> find_corners(const Ring2& ring) {
  if (ring.size() != 4) return {};
  for (std::size_t i = 0; i < 4; ++i)
    if (cross(ring[(i + 1) % 4] - ring[i], ring[(i + 2) % 4] - ring[(i + 1) % 4]) <= 1e-6)
      return {};
  const auto length = [&](std::size_t i) { return glm::distance(ring[i], ring[(i + 1) % 4]); };
  const std::size_t first = length(0) + length(2) >= length(1) + length(3) ? 0 : 1;
  Corners corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = ring[(first + i) % 4];
  return corners;
}

// Returns the mean length of the sides 1 and 3, m.
double find_mean_width(const Corners& c) {
  return (glm::distance(c[1], c[2]) + glm::distance(c[3], c[0])) / 2;
}

// The line between the middles of the short sides, shortened at both ends. None where it would have
// no length.
std::optional<std::array<glm::dvec2, 2>> find_ridge(const Corners& c, double inset_m) {
  const glm::dvec2 from = (c[3] + c[0]) / 2.0, to = (c[1] + c[2]) / 2.0;
  const double whole = glm::distance(from, to);
  if (whole < 2 * inset_m + 0.01) return {};
  const glm::dvec2 step = (to - from) / whole * inset_m;
  return std::array{from + step, to - step};
}

// Turns the corners by half where the direction leads to their last side, so that it leads to the
// side between the second and the third.
Corners turn_towards(const Corners& c, const glm::dvec2& direction) {
  const glm::dvec2 along = (c[1] + c[2]) / 2.0 - (c[3] + c[0]) / 2.0;
  return glm::dot(along, direction) < -1e-9 ? Corners{c[2], c[3], c[0], c[1]} : c;
}

// Adds faces from corners at one height to the ridge, or to one top where there is no room for it.
void add_hipped_top(Shell& shell, const Corners& c, double low_m) {
  const double top_m = shell.sizes().top_m;
  const auto ridge = find_ridge(c, find_mean_width(c) / 2);
  const auto low = [&](std::size_t i) { return glm::dvec3(c[i], low_m); };
  if (!ridge) {
    const glm::dvec3 top(*find_centroid({c.begin(), c.end()}), top_m);
    for (std::size_t i = 0; i < 4; ++i) shell.add_roof({low(i), low((i + 1) % 4), top});
    return;
  }
  const glm::dvec3 a((*ridge)[0], top_m), b((*ridge)[1], top_m);
  shell.add_roof({low(0), low(1), b, a});
  shell.add_roof({low(1), low(2), b});
  shell.add_roof({low(2), low(3), a, b});
  shell.add_roof({low(3), low(0), a});
}

// The corners of the quadrilateral whose sides lie `inset_m` further in. None where they would not
// be convex.
std::optional<Corners> shrink(const Corners& c, double inset_m) {
  Corners inner;
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec2 before = glm::normalize(c[i] - c[(i + 3) % 4]),
                     after = glm::normalize(c[(i + 1) % 4] - c[i]);
    const glm::dvec2 inward(-before.y - after.y, before.x + after.x);
    // Moves along the bisector as far as takes it off both sides.
    inner[i] = c[i] + inward * (inset_m / (1 + glm::dot(before, after)));
  }
  for (std::size_t i = 0; i < 4; ++i)
    if (glm::dot(inner[(i + 1) % 4] - inner[i], c[(i + 1) % 4] - c[i]) <= 1e-6) return {};
  return inner;
}

}  // namespace

bool add_pyramid(Shell& shell) {
  const Ring2& ring = shell.outer();
  const std::optional<glm::dvec2> top = find_centroid(ring);
  if (!top || !sees_each_edge(*top, ring)) return false;
  const double eaves = shell.sizes().eaves_m;
  shell.add_walls(ring, [&](const glm::dvec2&) { return eaves; });
  for (std::size_t i = 0; i < ring.size(); ++i)
    shell.add_roof({glm::dvec3(ring[i], eaves), glm::dvec3(ring[(i + 1) % ring.size()], eaves),
                    glm::dvec3(*top, shell.sizes().top_m)});
  return true;
}

bool add_hip(Shell& shell) {
  const auto corners = find_corners(shell.outer());
  if (!corners) return false;
  const double eaves = shell.sizes().eaves_m;
  shell.add_walls(shell.outer(), [&](const glm::dvec2&) { return eaves; });
  add_hipped_top(shell, *corners, eaves);
  return true;
}

bool add_half_hip(Shell& shell) {
  const auto corners = find_corners(shell.outer());
  if (!corners) return false;
  const Corners& c = *corners;
  const auto ridge = find_ridge(c, find_mean_width(c) / 4);
  if (!ridge) return false;
  const BuildingSizes& sizes = shell.sizes();
  const double middle_m = (sizes.eaves_m + sizes.top_m) / 2;
  const auto foot = [&](std::size_t i) { return glm::dvec3(c[i], sizes.foot_m); };
  const auto eave = [&](std::size_t i) { return glm::dvec3(c[i], sizes.eaves_m); };
  // A quarter of the way from corner i to corner j, where the gable has half its height.
  const auto shoulder = [&](std::size_t i, std::size_t j) {
    return glm::dvec3(c[i] + (c[j] - c[i]) / 4.0, middle_m);
  };
  const glm::dvec3 a((*ridge)[0], sizes.top_m), b((*ridge)[1], sizes.top_m);
  for (const std::size_t i : {0u, 2u}) shell.add_wall({foot(i), foot(i + 1), eave(i + 1), eave(i)});
  for (const std::size_t i : {1u, 3u}) {
    const std::size_t j = (i + 1) % 4;
    shell.add_wall({foot(i), foot(j), eave(j), shoulder(j, i), shoulder(i, j), eave(i)});
    shell.add_roof({shoulder(i, j), shoulder(j, i), i == 1 ? b : a});
  }
  shell.add_roof({eave(0), eave(1), shoulder(1, 2), b, a, shoulder(0, 3)});
  shell.add_roof({eave(2), eave(3), shoulder(3, 0), a, b, shoulder(2, 1)});
  return true;
}

bool add_side_hip(Shell& shell, const glm::dvec2& fall) {
  const auto corners = find_corners(shell.outer());
  if (!corners) return false;
  const Corners c = turn_towards(*corners, fall);
  const BuildingSizes& sizes = shell.sizes();
  const glm::dvec2 from = (c[3] + c[0]) / 2.0, to = (c[1] + c[2]) / 2.0;
  const double whole = glm::distance(from, to), inset = find_mean_width(c) / 2;
  if (whole < inset + 0.01) return false;
  const glm::dvec3 gable(from, sizes.top_m), hip(to - (to - from) / whole * inset, sizes.top_m);
  const auto foot = [&](std::size_t i) { return glm::dvec3(c[i], sizes.foot_m); };
  const auto eave = [&](std::size_t i) { return glm::dvec3(c[i], sizes.eaves_m); };
  for (const std::size_t i : {0u, 1u, 2u})
    shell.add_wall({foot(i), foot(i + 1), eave(i + 1), eave(i)});
  shell.add_wall({foot(3), foot(0), eave(0), gable, eave(3)});
  shell.add_roof({eave(0), eave(1), hip, gable});
  shell.add_roof({eave(1), eave(2), hip});
  shell.add_roof({eave(2), eave(3), gable, hip});
  return true;
}

bool add_side_half_hip(Shell& shell, const glm::dvec2& fall) {
  const auto corners = find_corners(shell.outer());
  if (!corners) return false;
  const Corners c = turn_towards(*corners, fall);
  const BuildingSizes& sizes = shell.sizes();
  const glm::dvec2 from = (c[3] + c[0]) / 2.0, to = (c[1] + c[2]) / 2.0;
  const double whole = glm::distance(from, to), inset = find_mean_width(c) / 4;
  if (whole < inset + 0.01) return false;
  const double middle_m = (sizes.eaves_m + sizes.top_m) / 2;
  const glm::dvec3 gable(from, sizes.top_m), hip(to - (to - from) / whole * inset, sizes.top_m),
      right(c[1] + (c[2] - c[1]) / 4.0, middle_m), left(c[2] + (c[1] - c[2]) / 4.0, middle_m);
  const auto foot = [&](std::size_t i) { return glm::dvec3(c[i], sizes.foot_m); };
  const auto eave = [&](std::size_t i) { return glm::dvec3(c[i], sizes.eaves_m); };
  for (const std::size_t i : {0u, 2u}) shell.add_wall({foot(i), foot(i + 1), eave(i + 1), eave(i)});
  shell.add_wall({foot(1), foot(2), eave(2), left, right, eave(1)});
  shell.add_wall({foot(3), foot(0), eave(0), gable, eave(3)});
  shell.add_roof({eave(0), eave(1), right, hip, gable});
  shell.add_roof({right, left, hip});
  shell.add_roof({eave(2), eave(3), gable, hip, left});
  return true;
}

bool add_gablet(Shell& shell) {
  const auto corners = find_corners(shell.outer());
  if (!corners) return false;
  const Corners& c = *corners;
  const auto ridge = find_ridge(c, find_mean_width(c) / 2);
  if (!ridge) return false;
  const BuildingSizes& sizes = shell.sizes();
  const double middle_m = (sizes.eaves_m + sizes.top_m) / 2;
  shell.add_walls(shell.outer(), [&](const glm::dvec2&) { return sizes.eaves_m; });
  const auto eave = [&](std::size_t i) { return glm::dvec3(c[i], sizes.eaves_m); };
  // The middle of the edge between a hip and the slope beside it.
  const auto shoulder = [&](std::size_t i) {
    const bool is_first = i == 0 || i == 3;
    return glm::dvec3((c[i] + (*ridge)[is_first ? 0 : 1]) / 2.0, middle_m);
  };
  const auto top = [&](std::size_t i, std::size_t j) {
    return glm::dvec3(glm::dvec2(shoulder(i) + shoulder(j)) / 2.0, sizes.top_m);
  };
  const glm::dvec3 a = top(3, 0), b = top(1, 2);
  shell.add_roof({eave(0), eave(1), shoulder(1), b, a, shoulder(0)});
  shell.add_roof({eave(2), eave(3), shoulder(3), a, b, shoulder(2)});
  for (const std::size_t i : {1u, 3u}) {
    const std::size_t j = (i + 1) % 4;
    shell.add_roof({eave(i), eave(j), shoulder(j), shoulder(i)});
    shell.add_wall({shoulder(i), shoulder(j), i == 1 ? b : a});
  }
  return true;
}

bool add_quadruple_saltbox(Shell& shell) {
  const auto corners = find_corners(shell.outer());
  if (!corners) return false;
  const auto inner = shrink(*corners, find_mean_width(*corners) / 3);
  if (!inner) return false;
  const double eaves = shell.sizes().eaves_m, top = shell.sizes().top_m;
  shell.add_walls(shell.outer(), [&](const glm::dvec2&) { return eaves; });
  city::Ring flat;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    shell.add_roof({glm::dvec3((*corners)[i], eaves), glm::dvec3((*corners)[j], eaves),
                    glm::dvec3((*inner)[j], top), glm::dvec3((*inner)[i], top)});
    flat.emplace_back((*inner)[i], top);
  }
  shell.add_roof(std::move(flat));
  return true;
}

bool add_crossed_gables(Shell& shell) {
  const auto corners = find_corners(shell.outer());
  if (!corners) return false;
  const Corners& c = *corners;
  const BuildingSizes& sizes = shell.sizes();
  const glm::dvec3 middle((c[0] + c[1] + c[2] + c[3]) / 4.0, sizes.top_m);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    const glm::dvec3 from(c[i], sizes.eaves_m), to(c[j], sizes.eaves_m),
        gable((c[i] + c[j]) / 2.0, sizes.top_m);
    shell.add_wall(
        {glm::dvec3(c[i], sizes.foot_m), glm::dvec3(c[j], sizes.foot_m), to, gable, from});
    shell.add_roof({from, gable, middle});
    shell.add_roof({gable, to, middle});
  }
  return true;
}

bool add_mansard(Shell& shell) {
  const auto corners = find_corners(shell.outer());
  if (!corners) return false;
  const double share = std::numbers::sqrt2 / 2, eaves = shell.sizes().eaves_m;
  const auto inner = shrink(*corners, (1 - share) * find_mean_width(*corners) / 2);
  if (!inner) return false;
  const double break_m = eaves + share * shell.rise_m();
  shell.add_walls(shell.outer(), [&](const glm::dvec2&) { return eaves; });
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    shell.add_roof({glm::dvec3((*corners)[i], eaves), glm::dvec3((*corners)[j], eaves),
                    glm::dvec3((*inner)[j], break_m), glm::dvec3((*inner)[i], break_m)});
  }
  add_hipped_top(shell, *inner, break_m);
  return true;
}

}  // namespace nightcity::map_buildings
