// Light that the eye scatters around bright things, as weights of a pyramid of Gaussians.
#pragma once

#include <vector>

namespace nightcity::render {

/// Returns the total point spread function of the eye of somebody of an age in years, 1/sr, at an
/// angle in degrees: Vos, van den Berg: Report on disability glare, CIE 135/1, 1999, for brown eyes
/// (pigmentation 0.5), without its two last terms, which do not depend on where the light is (0.3 %
/// of it per sr).
double glare_at(double angle_deg, double age);

/// Returns the weights of the levels of a pyramid (shaders/glare.glsl) whose sum is that function.
/// Level 0, the picture itself, keeps the light that is scattered by less than a pixel. Light that
/// is scattered further than the last level spreads it leaves the picture. No light is added: the
/// published terms, which sum to 1.02, are divided by their sum. `pixel_rad` is the angle of a
/// pixel, `last` the last level, at least 1.
///
/// Each term A / (1 + (x / a)^2)^n of the function is a sum of Gaussians of all widths s, with the
/// energy A pi a^2 / Gamma(n) t^(n - 2) e^-t dt where t = a^2 / (2 s^2); level k gets that of the
/// widths nearer to its own than to another level's. From 8 pixels to a quarter of the picture's
/// side, that is within 7 % of the function in the mean over a ring, and within 23 % at a pixel.
std::vector<double> glare_weights(double age, double pixel_rad, unsigned last);

}  // namespace nightcity::render
