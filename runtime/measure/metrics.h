// How far a picture is from its reference.
#pragma once

#include <optional>

#include "runtime/measure/image.h"

namespace nightcity {

/// Of picture A against reference B; luminance Y by Rec. 709, "mean" over all pixels, sums in double.
struct Comparison {
  /// Root mean square difference of the 8-bit display values (0..255) over pixels and channels, both pictures
  /// through the same exposure and the filmic curve.
  double rmse8 = 0;
  /// Mean over pixels and channels of (a - b)^2 / (b^2 + eps), eps = 0.01 * (mean of B's channels)^2: the
  /// floor keeps pixels a tenth as bright as the mean and darker from deciding the figure.
  double relative_mse = 0;
  /// The same over luminances.
  double relative_mse_luminance = 0;
  /// Mean of Y(a) - Y(b), cd/m2: below zero where A is darker.
  double mean_signed_error = 0;
  /// mean_signed_error / mean of Y(b).
  double relative_mean_signed_error = 0;
  /// Share of pixels with Y(a) > 10 * (greatest Y(b) of the 3 x 3 pixels around + 0.1 * mean of Y(b)): a lamp
  /// that B has next door is not a firefly, nor is noise in the dark that no eye finds.
  double fireflies = 0;
  float ev100 = 0;                      // exposure of rmse8
  double mean_luminance = 0;            // of A, cd/m2
  double reference_mean_luminance = 0;  // of B, cd/m2
};

/// `ev100`: exposure of rmse8; left out, the one B carries, else B's auto_exposure_ev100: always one for
/// both. Throws Error: sizes differ, no pixels, a value that is not finite (which picture, which pixel), or B
/// black and A not, when nothing relative exists. Two black pictures differ by nothing.
Comparison compare(const Image& a, const Image& b, std::optional<float> ev100 = std::nullopt);

}  // namespace nightcity
