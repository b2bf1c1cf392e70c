#include "runtime/measure/significance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/error.h"
#include "shaders/tonemap.glsl.h"

namespace nightcity::measure {
namespace {

// The continued fraction of the incomplete beta function (DLMF 8.17.22) by the modified Lentz
// algorithm. It converges fast for x < (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x) {
  constexpr double tiny = 1e-300;
  double c = 1, d = 1 - (a + b) * x / (a + 1);
  d = 1 / (std::abs(d) < tiny ? tiny : d);
  double value = d;
  for (int m = 1; m < 500; ++m) {
    const double k = m;
    for (const double step : {k * (b - k) * x / ((a + 2 * k - 1) * (a + 2 * k)),
                              -(a + k) * (a + b + k) * x / ((a + 2 * k) * (a + 2 * k + 1))}) {
      d = 1 + step * d;
      d = 1 / (std::abs(d) < tiny ? tiny : d);
      c = 1 + step / c;
      c = std::abs(c) < tiny ? tiny : c;
      value *= c * d;
    }
    if (std::abs(c * d - 1) < 1e-14) break;
  }
  return value;
}

// The regularised incomplete beta function I_x(a, b).
double incomplete_beta(double a, double b, double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                a * std::log(x) + b * std::log1p(-x));
  if (x < (a + 1) / (a + b + 2)) return front * beta_fraction(a, b, x) / a;
  return 1 - front * beta_fraction(b, a, 1 - x) / b;
}

double freedom_of(double va, double vb, const PictureStatistics& a, const PictureStatistics& b) {
  const double freedom_a = std::max(1.0, double(a.runs()) - 1),
               freedom_b = std::max(1.0, double(b.runs()) - 1);
  return (va + vb) * (va + vb) / (va * va / freedom_a + vb * vb / freedom_b);
}

}  // namespace

void PictureStatistics::add(const Image& picture) {
  if (runs_ == 0) {
    mean_.assign(picture.pixels(), 0);
    squares_.assign(picture.pixels(), 0);
  }
  if (picture.pixels() != mean_.size()) throw Error({}, "the pictures differ in size");
  ++runs_;
  double sum = 0;
  for (std::size_t i = 0; i < mean_.size(); ++i) {
    const float* rgb = &picture.rgb[3 * i];
    const double y = double(tonemap::luminance_709(rgb[0], rgb[1], rgb[2]));
    if (!std::isfinite(y)) throw Error({}, fmt::format("pixel {} is not a finite number", i));
    const double before = y - mean_[i];
    mean_[i] += before / runs_;
    squares_[i] += before * (y - mean_[i]);
    sum += y;
  }
  picture_means_.push_back(sum / double(mean_.size()));
}

double PictureStatistics::variance_of_mean(std::size_t pixel) const {
  return runs_ < 2 ? 0.0 : squares_[pixel] / (double(runs_) * (double(runs_) - 1));
}

double PictureStatistics::picture_mean() const {
  double sum = 0;
  for (const double m : picture_means_) sum += m;
  return sum / double(std::max<std::size_t>(1, picture_means_.size()));
}

double PictureStatistics::picture_mean_error() const {
  if (runs_ < 2) return 0;
  const double mean = picture_mean();
  double squares = 0;
  for (const double m : picture_means_) squares += (m - mean) * (m - mean);
  return std::sqrt(squares / (double(runs_) * (double(runs_) - 1)));
}

PixelTest test_pixels(const PictureStatistics& a, const PictureStatistics& b, double significance,
                      double tolerance) {
  if (a.pixels() != b.pixels()) throw Error({}, "the pictures differ in size");
  PixelTest test;
  test.pixels = a.pixels();
  test.level = sidak_level(significance, test.pixels);
  const double mean_b = b.picture_mean();
  double passed_a = 0, passed_b = 0;
  for (std::size_t i = 0; i < test.pixels; ++i) {
    const double allowed = tolerance * (std::abs(b.mean(i)) + std::abs(mean_b));
    const double difference = std::max(0.0, std::abs(a.mean(i) - b.mean(i)) - allowed);
    const double va = a.variance_of_mean(i), vb = b.variance_of_mean(i);
    double p = 1;
    if (difference > 0)
      p = va + vb > 0 ? student_tails(difference / std::sqrt(va + vb), freedom_of(va, vb, a, b))
                      : 0.0;
    if (p < test.level) {
      ++test.rejected;
    } else {
      passed_a += a.mean(i);
      passed_b += b.mean(i);
    }
    if (p < test.min_p) {
      test.min_p = p;
      test.min_pixel = i;
    }
  }
  if (passed_b != 0) test.relative_mean_passed = passed_a / passed_b - 1;
  if (mean_b != 0) {
    test.relative_mean = a.picture_mean() / mean_b - 1;
    test.relative_mean_error =
        std::hypot(a.picture_mean_error(), b.picture_mean_error()) / std::abs(mean_b);
  }
  return test;
}

double student_tails(double t, double freedom) {
  return incomplete_beta(freedom / 2, 0.5, freedom / (freedom + t * t));
}

double find_student_bound(double probability, double freedom) {
  double low = 0, high = 1;
  while (student_tails(high, freedom) > probability) high *= 2;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (student_tails(middle, freedom) > probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::optional<double> find_confidence(const std::vector<double>& values, double level) {
  if (values.size() < 2) return {};
  const double n = double(values.size());
  double mean = 0, squares = 0;
  for (const double value : values) mean += value / n;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return find_student_bound(1 - level, n - 1) * std::sqrt(squares / (n * (n - 1)));
}

double find_series_error(const std::vector<double>& series) {
  const std::size_t n = series.size();
  if (n < 2) return 0;
  double mean = 0;
  for (const double value : series) mean += value / double(n);
  const auto covariance = [&](std::size_t lag) {
    double sum = 0;
    for (std::size_t i = lag; i < n; ++i) sum += (series[i] - mean) * (series[i - lag] - mean);
    return sum / double(n);
  };
  const double variance = covariance(0);
  if (!(variance > 0)) return 0;
  // 1 + 2 (sum of all lags) = -1 + 2 (sum of pairs of lags from 0 on); those below 0 are noise.
  double time = -1;
  for (std::size_t lag = 0; lag + 1 < n; lag += 2) {
    const double pair = (covariance(lag) + covariance(lag + 1)) / variance;
    if (!(pair > 0)) break;
    time += 2 * pair;
  }
  return std::sqrt(variance * std::max(time, 1.0) / double(n - 1));
}

double sidak_level(double significance, std::size_t tests) {
  return tests == 0 ? significance : -std::expm1(std::log1p(-significance) / double(tests));
}

}  // namespace nightcity::measure
