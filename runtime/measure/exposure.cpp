#include "runtime/measure/exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "formats/error.h"

namespace nightcity::measure {

namespace {

constexpr float emitters_over_ev = 6;

// Meters the pixels for which `counts(pixel)` holds.
template <class Counts>
float meter(const Image& image, Counts counts) {
  std::vector<float> log_luminance;
  log_luminance.reserve(image.pixels());
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    if (!counts(i)) continue;
    const float y =
        tonemap::luminance_709(image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2]);
    if (std::isfinite(y) && y > 0.0f) log_luminance.push_back(std::log2(y));
  }
  if (log_luminance.empty()) return default_ev100;

  const std::size_t kept =
      std::max<std::size_t>(1, log_luminance.size() - log_luminance.size() / 50);
  if (kept < log_luminance.size())
    std::nth_element(log_luminance.begin(),
                     log_luminance.begin() + static_cast<std::ptrdiff_t>(kept),
                     log_luminance.end());
  double sum = 0.0, weight_sum = 0.0;
  for (std::size_t i = 0; i < kept; ++i) {
    const double weight = std::exp2(double(log_luminance[i]));
    sum += weight * log_luminance[i];
    weight_sum += weight;
  }
  const double mean_log2 = sum / weight_sum;
  constexpr double meter_k = 12.5;
  const double ev100 = mean_log2 + std::log2(100.0 / meter_k);
  return static_cast<float>(std::clamp(ev100, -12.0, 24.0));
}

}  // namespace

float auto_exposure_ev100(const Image& image) {
  const float all = meter(image, [](std::size_t) { return true; });
  const ImageLayer* emitters = image.layer("emitter");
  if (!emitters) return all;
  const std::vector<float>& values = emitters->values;
  if (std::find(values.begin(), values.end(), 0.0f) == values.end()) return all;
  const float lit = meter(image, [&](std::size_t i) { return values[i] == 0; });
  return std::max(lit, all - emitters_over_ev);
}

std::uint32_t tone_curve_from_name(const std::string& name) {
  for (const std::uint32_t curve : {TONEMAP_FILMIC, TONEMAP_REINHARD, TONEMAP_LINEAR})
    if (name == tone_curve_name(curve)) return curve;
  throw UsageError({}, "unknown tone curve \"" + name + "\": filmic, reinhard or linear");
}

const char* tone_curve_name(std::uint32_t curve) {
  switch (curve) {
    case TONEMAP_LINEAR:
      return "linear";
    case TONEMAP_REINHARD:
      return "reinhard";
    default:
      return "filmic";
  }
}

std::uint8_t to_code_value(float exposed, std::uint32_t curve) {
  // tone_curve maps NaN to 0, because its comparison with 0 is false.
  const float code = tonemap::srgb_encode(tonemap::tone_curve(curve, exposed));
  return static_cast<std::uint8_t>(std::lround(255.0f * std::min(code, 1.0f)));
}

Image8 to_display(const Image& image, float ev100, std::uint32_t curve) {
  Image8 display{image.width, image.height, std::vector<std::uint8_t>(image.rgb.size())};
  const float scale = tonemap::exposure_scale(ev100);
  std::transform(image.rgb.begin(), image.rgb.end(), display.rgb.begin(),
                 [=](float value) { return to_code_value(value * scale, curve); });
  return display;
}

}  // namespace nightcity::measure
