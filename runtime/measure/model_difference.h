// The difference between two pictures that are known only with noise, without that noise: from
// several independent pictures of each.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "runtime/measure/image.h"

namespace nightcity::measure {

/// A value and the standard error of it.
struct Estimate {
  double value = 0, error = 0;
};

/// The distance of the expected picture A from the expected picture B, as in Comparison
/// (metrics.h).
struct ModelDifference {
  Estimate relative_mean;  // (mean of A - mean of B) / mean of B, of luminances
  Estimate relative_mse;
  Estimate mse8;              // square of the RMSE of 8-bit display values
  double reference_mean = 0;  // of B, cd/m2
  float ev100 = 0;            // exposure of mse8

  /// Returns the root of mse8, with its standard error.
  Estimate rmse8() const;
};

/// Returns the difference. Picture i of A and picture i of B form a pair; all pictures are
/// independent of each other (other seeds). With D_i the difference of a pair in a pixel, the mean
/// of D_i D_j over all i != j estimates the square of the expected difference without bias: noise
/// of different pairs is uncorrelated, so that it adds nothing. Such an estimate of a small square
/// may be below zero. Standard errors are by the jackknife over pairs (Tukey 1958): their squares
/// are on average not below the variance (Efron, Stein 1981), for four noisy pairs about twice as
/// large.
///
/// The divisors of the relative MSE are of the mean of B's pictures: noise in that changes them,
/// and with them the result, by a share of about the square of the relative noise. Differences of
/// display values are of the expected display values, which for a noisy picture are not those of
/// the expected picture; both sides have the same noise. mse8 counts values before they are rounded
/// to 8 bits. `ev100`: exposure for both sides; by default metered from the mean of B. `left_out`:
/// pixels that do not count on either side, but in that metering; empty: none. Throws Error where
/// there are fewer than three pairs, sizes differ, a value is not finite, every pixel is left out,
/// or B is black and A is not.
ModelDifference find_model_difference(std::span<const Image> a, std::span<const Image> b,
                                      std::optional<float> ev100 = std::nullopt,
                                      const std::vector<bool>& left_out = {});

/// Returns the root of an estimate of a square, 0 where that is below 0.
Estimate root_of(const Estimate& square);

}  // namespace nightcity::measure
