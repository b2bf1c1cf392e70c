#include "runtime/measure/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "formats/error.h"
#include "runtime/measure/exposure.h"

namespace nightcity::measure {
namespace {

std::vector<float> luminances(const Image& image, const char* which) {
  std::vector<float> y(image.pixels());
  for (std::size_t i = 0; i < y.size(); ++i) {
    const float* rgb = &image.rgb[3 * i];
    if (!std::isfinite(rgb[0]) || !std::isfinite(rgb[1]) || !std::isfinite(rgb[2]))
      throw Error({}, fmt::format("{}, pixel ({}, {})", which, i % image.width, i / image.width),
                  "not a finite number");
    y[i] = tonemap::luminance_709(rgb[0], rgb[1], rgb[2]);
  }
  return y;
}

double mean(std::span<const float> values) {
  double sum = 0.0;
  for (const float value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double root_mean_square_8bit(const Image& a, const Image& b, float ev100) {
  const Image8 shown_a = to_display(a, ev100), shown_b = to_display(b, ev100);
  double sum = 0.0;
  for (std::size_t i = 0; i < shown_a.rgb.size(); ++i) {
    const int difference = int{shown_a.rgb[i]} - int{shown_b.rgb[i]};
    sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<double>(shown_a.rgb.size()));
}

double relative_square_error(std::span<const float> a, std::span<const float> b) {
  const double mean_b = mean(b);
  const double floor = 0.01 * mean_b * mean_b;
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = double{a[i]} - double{b[i]};
    sum += difference * difference / (double{b[i]} * double{b[i]} + floor);
  }
  return sum / static_cast<double>(a.size());
}

double share_of_fireflies(std::span<const float> a, std::span<const float> b, double mean_b,
                          std::uint32_t width, std::uint32_t height) {
  std::size_t fireflies = 0;
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      float brightest = 0.0f;
      for (std::uint32_t v = y - (y > 0); v <= std::min(y + 1, height - 1); ++v)
        for (std::uint32_t u = x - (x > 0); u <= std::min(x + 1, width - 1); ++u)
          brightest = std::max(brightest, b[std::size_t{v} * width + u]);
      if (a[std::size_t{y} * width + x] > 10.0 * (brightest + 0.1 * mean_b)) ++fireflies;
    }
  }
  return static_cast<double>(fireflies) / static_cast<double>(a.size());
}

}  // namespace

Comparison compare(const Image& a, const Image& b, std::optional<float> ev100) {
  if (a.width != b.width || a.height != b.height)
    throw Error({}, fmt::format("the pictures differ in size: {} x {} and {} x {}", a.width,
                                a.height, b.width, b.height));
  if (a.pixels() == 0) throw Error({}, "the pictures have no pixels");

  const std::vector<float> ya = luminances(a, "first picture"),
                           yb = luminances(b, "second picture (reference)");
  Comparison result;
  result.mean_luminance = mean(ya);
  result.reference_mean_luminance = mean(yb);
  result.ev100 = ev100 ? *ev100 : b.info.ev100 ? *b.info.ev100 : auto_exposure_ev100(b);
  result.rmse8 = root_mean_square_8bit(a, b, result.ev100);
  result.mean_signed_error = result.mean_luminance - result.reference_mean_luminance;

  const auto is_zero = [](float value) { return value == 0.0f; };
  if (!(result.reference_mean_luminance > 0.0) || !(mean(b.rgb) > 0.0)) {
    if (std::all_of(a.rgb.begin(), a.rgb.end(), is_zero) &&
        std::all_of(b.rgb.begin(), b.rgb.end(), is_zero))
      return result;
    throw Error({}, "the reference is black, so there is no error relative to it");
  }
  result.relative_mse = relative_square_error(a.rgb, b.rgb);
  result.relative_mse_luminance = relative_square_error(ya, yb);
  result.relative_mean_signed_error = result.mean_signed_error / result.reference_mean_luminance;
  result.fireflies = share_of_fireflies(ya, yb, result.reference_mean_luminance, a.width, a.height);
  return result;
}

}  // namespace nightcity::measure
