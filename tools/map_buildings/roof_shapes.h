// Roofs over outlines without holes. Each function adds roof and walls, and returns false, having
// added nothing, where its shape does not fit the outline.
#pragma once

#include <vector>

#include "tools/map_buildings/rectangle.h"
#include "tools/map_buildings/shell.h"

namespace nightcity::map_buildings {

/// A cross-section of a roof that is the same all along it: heights at places across, both rising.
/// Places are metres from the middle of the box; heights are those of `sizes`.
struct RoofProfile {
  struct Corner {
    double place_m, height_m;
  };
  std::vector<Corner> corners;
};

/// Two slopes of equal height.
RoofProfile make_gable(const BuildingSizes& sizes, double width_m);
/// Two slopes with a break, whose corners lie on half an ellipse at 45 degrees: a half-circle where
/// the roof is half as high as wide. (The shape is an assumption.)
RoofProfile make_gambrel(const BuildingSizes& sizes, double width_m);
/// An arc of a circle, and half an ellipse where that is higher than half its width, in 12 chords.
RoofProfile make_round(const BuildingSizes& sizes, double width_m);
/// Two slopes of equal angle, the ridge at a third of the width: the eaves of the short slope lie
/// half of the rise above those of the long one, on the far side. (A third is an assumption.)
RoofProfile make_saltbox(const BuildingSizes& sizes, double width_m);

/// Two slopes that fall to a valley in the middle.
RoofProfile make_butterfly(const BuildingSizes& sizes, double width_m);
/// A slope on either side of a flat third. (The thirds are an assumption.)
RoofProfile make_double_saltbox(const BuildingSizes& sizes, double width_m);
/// Teeth of some row_step_m, two at least: each a slope that rises, and a face that is all but
/// upright.
RoofProfile make_sawtooth(const BuildingSizes& sizes, double width_m);
/// Gables of some row_step_m side by side, two at least.
RoofProfile make_gabled_row(const BuildingSizes& sizes, double width_m);
/// The width of a tooth or gable in a row of them. (An assumption.)
constexpr double row_step_m = 6;

/// Spans the profile over the outline, its corners across the unit vector `along`, to the left of
/// it. Fails where a corner's line cuts the outline more than twice.
bool add_profile(Shell& shell, const glm::dvec2& middle, const glm::dvec2& along,
                 const RoofProfile& profile);

/// A triangle from each edge to a top over the centroid. Fails where that does not see each edge.
bool add_pyramid(Shell& shell);
/// Over four convex corners, its ridge half of the shorter sides' mean away from these.
bool add_hip(Shell& shell);
/// Over four convex corners: the gable's upper half at both ends falls to the outside as steeply as
/// the long sides do.
bool add_half_hip(Shell& shell);
/// Over four convex corners: a hipped roof with the break of a gambrel all round.
bool add_mansard(Shell& shell);
/// Over four convex corners: a hip at the end that `fall` leads to, a gable at the other.
bool add_side_hip(Shell& shell, const glm::dvec2& fall);
/// The same with half a hip.
bool add_side_half_hip(Shell& shell, const glm::dvec2& fall);
/// Over four convex corners: hips that end in gables at half of their height.
bool add_gablet(Shell& shell);
/// Over four convex corners: slopes from all sides to a flat top, a third of the width away from
/// them. (The third is an assumption.)
bool add_quadruple_saltbox(Shell& shell);
/// Over four convex corners: a gable on each side, their ridges meet in the middle.
bool add_crossed_gables(Shell& shell);

/// Half an ellipsoid over the outline: smaller copies of it round the centroid, in 8 rings. Fails
/// where the outline is not compact (4 pi A / P^2 below 0.5) or the centroid does not see each
/// edge.
bool add_dome(Shell& shell);
/// As a dome, of the radius cos^2(pi t / 2) (1 + 1.5 t) at the share t of the height: 18 % beyond
/// the outline at a fifth, a tip at the top. (The curve is an assumption.)
bool add_onion(Shell& shell);

}  // namespace nightcity::map_buildings
