// Measures of the error of a picture against its reference.
#pragma once

#include <optional>

#include "runtime/measure/image.h"

namespace nightcity::measure {

/// The error of picture A against reference B. Y is the luminance by Rec. 709; means are over all
/// pixels.
struct Comparison {
  /// Root mean square difference of the 8-bit display values (0..255) over pixels and channels,
  /// with the same exposure and the filmic curve for both pictures.
  double rmse8 = 0;
  /// Mean over pixels and channels of (a - b)^2 / (b^2 + eps) with eps = 0.01 * (mean of B's
  /// channels)^2. The floor keeps pixels that are darker than a tenth of the mean from dominating
  /// the result.
  double relative_mse = 0;
  /// The same over luminances.
  double relative_mse_luminance = 0;
  /// Mean of Y(a) - Y(b), cd/m2: below zero where A is darker.
  double mean_signed_error = 0;
  /// mean_signed_error / mean of Y(b).
  double relative_mean_signed_error = 0;
  /// Share of pixels with Y(a) > 10 * (greatest Y(b) of the 3 x 3 pixels around + 0.1 * mean of
  /// Y(b)). So a lamp that B has one pixel away is no firefly, and neither is invisible noise in
  /// the dark.
  double fireflies = 0;
  float ev100 = 0;                      // exposure of rmse8
  double mean_luminance = 0;            // of A, cd/m2
  double reference_mean_luminance = 0;  // of B, cd/m2
};

/// Compares picture and reference. `ev100` is the exposure of rmse8 for both; by default the one
/// that B carries, else B's auto_exposure_ev100. Throws Error when the sizes differ, there are no
/// pixels, a value is not finite (the message names picture and pixel), or B is black and A is not,
/// so that no relative error exists. Two black pictures do not differ.
Comparison compare(const Image& a, const Image& b, std::optional<float> ev100 = std::nullopt);

}  // namespace nightcity::measure
