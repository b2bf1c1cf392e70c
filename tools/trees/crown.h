// The crown of a tree as loose leaves, through whose gaps light passes.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace nightcity::trees {

/// The share of direct light that passes the crowns of single trees in towns (J. Konarska et al.,
/// Transmissivity of solar radiation through crowns of single urban trees, Theor. Appl. Climatol.
/// 117, 2014): 1.3 to 5.3 % with leaves and 40.2 to 51.9 % without; the middles.
constexpr double gap_with_leaves = 0.033, gap_without_leaves = 0.46;

/// Returns the share of parallel light on a ball that passes it, where leaves are strewn and turned
/// at random: the mean of exp(-depth c) over its chords c, in diameters. `depth`: mean number of
/// leaves along a diameter. (Beer's law in a canopy, Monsi and Saeki 1953; chords of a ball are
/// distributed as 2 c.)
double find_mean_gap(double depth);
/// Returns the depth of a ball whose mean gap is `gap`, in (0, 1).
double find_depth(double gap);

using LeafQuad = std::array<glm::vec3, 4>;

/// Returns the leaves of a crown, rectangles of `length` by `width` in radii with their middles in
/// the unit ball: as many as let the share `gap` of parallel light that falls on the ball pass it,
/// in the mean over all directions, to 0.1 % of what falls. Of small leaves that is
/// n = 4/3 pi depth / (length width), since a leaf that is turned at random shows half its area
/// (Cauchy); larger ones reach beyond the ball, and it takes more of them. The same seed gives the
/// same leaves.
std::vector<LeafQuad> make_leaves(double gap, double length, double width, std::uint64_t seed);

}  // namespace nightcity::trees
