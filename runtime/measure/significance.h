// Tests whether two noisy pictures differ by more than noise: pixel by pixel, corrected for the
// number of tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/measure/image.h"

namespace nightcity::measure {

/// Mean luminance of pictures of one view, and the variance of that mean, pixel by pixel (Welford
/// 1962). The pictures must be independent (different seeds, no shared history): frames that reuse
/// each other's samples are not, and their variance would be underestimated.
class PictureStatistics {
 public:
  /// Throws Error when the picture differs in size from the first or holds a value that is not
  /// finite.
  void add(const Image& picture);

  std::uint32_t runs() const { return runs_; }
  std::size_t pixels() const { return mean_.size(); }
  double mean(std::size_t pixel) const { return mean_[pixel]; }
  /// 0 for a single picture, which then counts as exact.
  double variance_of_mean(std::size_t pixel) const;
  /// The mean over all pixels, and its standard error from the variance of the pictures' own means.
  double picture_mean() const;
  double picture_mean_error() const;

 private:
  std::vector<double> mean_, squares_;  // squares_: sum of squared deviations
  std::vector<double> picture_means_;
  std::uint32_t runs_ = 0;
};

struct PixelTest {
  std::size_t pixels = 0;
  std::size_t rejected = 0;  // pixels whose difference is significant at the corrected level
  double level = 0;          // of significance of a single pixel, after the correction
  double min_p = 1;          // of all pixels
  std::size_t min_pixel = 0;
  double relative_mean = 0;         // (mean of A - mean of B) / mean of B
  double relative_mean_error = 0;   // its standard error
  double relative_mean_passed = 0;  // relative_mean of the pixels that were not rejected

  double passed_share() const { return pixels ? 1.0 - double(rejected) / double(pixels) : 1.0; }
};

/// Runs Welch's test of equal means for every pixel, with Sidak's correction: for equal pictures,
/// the chance that any pixel is rejected is `significance`. The renderer tests of Mitsuba 3 do the
/// same with a Z test; the variances here are estimates, so Welch's test is used. `tolerance` is
/// how much A may differ apart from noise: this share of the pixel in B plus this share of B's
/// mean. Throws Error when the sizes differ.
PixelTest test_pixels(const PictureStatistics& a, const PictureStatistics& b,
                      double significance = 0.01, double tolerance = 0);

/// Returns the probability that a Student t of `freedom` degrees lies farther from 0 than |t|.
double student_tails(double t, double freedom);

/// Returns the t that a Student t of `freedom` degrees exceeds in magnitude with this probability,
/// in (0, 1): the inverse of student_tails.
double find_student_bound(double probability, double freedom);

/// Returns half the width of the confidence interval of the mean of `values` at this level (0.95):
/// Student's t times the standard error. Nothing for fewer than two values.
std::optional<double> find_confidence(const std::vector<double>& values, double level);

/// Returns the standard error of the mean of values that follow each other and may be correlated,
/// as errors of frames that reuse each other's samples are: that of independent values times the
/// root of the integrated autocorrelation time, whose sum ends with the initial positive sequence
/// (Geyer 1992, section 3.3). A series that is not many times as long as its values are correlated
/// has too small a one. 0 for fewer than two values.
double find_series_error(const std::vector<double>& series);

/// Returns the level of each of `tests` independent tests whose joint level is `significance`
/// (Sidak 1967).
double sidak_level(double significance, std::size_t tests);

}  // namespace nightcity::measure
