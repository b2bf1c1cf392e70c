// Thins a surface of the ground to the vertices that it needs.
#pragma once

#include <span>
#include <vector>

#include "tools/mesh/triangle_mesh.h"

namespace nightcity::terrain {

/// Returns a Delaunay surface (in plan) through some of the vertices of `surface`, such that none
/// of the others lies more than `max_error_m` above or below it: where the error is greatest, a
/// vertex is added, until it is small enough everywhere (greedy insertion: Garland and Heckbert
/// 1995, "Fast Polygonal Approximation of Terrains and Height Fields", here with a vertex a
/// triangle at a time). The outline stays, so that neighbours still meet, but for vertices that
/// `loose` marks (empty: none): each lies on the straight line between the next ones of the outline
/// that are not.
///
/// Triangles are in E, N, H; all of the result's are like the first. Returns `surface` itself where
/// it is no such thing as a height field, as where triangles face down, overlap or stand upright,
/// and where nothing can be left out.
mesh::TriangleMesh thin_surface(const mesh::TriangleMesh& surface, double max_error_m,
                                const std::vector<bool>& loose = {});

/// Returns which of some heights, evenly spaced along a line, are needed for the others to be
/// within `max_error_m` of the straight lines between them (Douglas and Peucker 1973); the first
/// and the last always are.
std::vector<bool> find_needed(std::span<const double> heights, double max_error_m);

}  // namespace nightcity::terrain
