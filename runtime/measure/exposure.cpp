#include "runtime/measure/exposure.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "formats/error.h"

namespace nightcity::measure {

namespace {

constexpr float emitters_over_ev = 6;

struct MeteredPixel {
  float luminance;
  std::size_t index;
};

// Returns those of the pixels for which `counts(pixel)` holds that are finite and positive, without
// their brightest fiftieth.
template <class Counts>
std::vector<MeteredPixel> find_metered(const Image& image, Counts counts) {
  std::vector<MeteredPixel> pixels;
  pixels.reserve(image.pixels());
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    if (!counts(i)) continue;
    const float y =
        tonemap::luminance_709(image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2]);
    if (std::isfinite(y) && y > 0.0f) pixels.push_back({y, i});
  }
  if (pixels.empty()) return pixels;
  const std::size_t kept = std::max<std::size_t>(1, pixels.size() - pixels.size() / 50);
  if (kept < pixels.size())
    std::nth_element(
        pixels.begin(), pixels.begin() + static_cast<std::ptrdiff_t>(kept), pixels.end(),
        [](const MeteredPixel& a, const MeteredPixel& b) { return a.luminance < b.luminance; });
  pixels.resize(kept);
  return pixels;
}

// Returns the EV100 of the pixels for which `counts(pixel)` holds, if any can be metered.
template <class Counts>
std::optional<double> meter(const Image& image, Counts counts) {
  const std::vector<MeteredPixel> pixels = find_metered(image, counts);
  if (pixels.empty()) return {};
  double sum = 0.0, weight_sum = 0.0;
  for (const MeteredPixel& pixel : pixels) {
    const double log_luminance = std::log2(double(pixel.luminance));
    const double weight = double(pixel.luminance);
    sum += weight * log_luminance;
    weight_sum += weight;
  }
  const double mean_log2 = sum / weight_sum;
  constexpr double meter_k = 12.5;
  return mean_log2 + std::log2(100.0 / meter_k);
}

// Returns auto_exposure_ev100() without its bounds, if any pixel can be metered.
std::optional<double> meter(const Image& image) {
  const std::optional<double> all = meter(image, [](std::size_t) { return true; });
  const ImageLayer* emitters = image.layer("emitter");
  if (!all || !emitters) return all;
  const std::vector<float>& values = emitters->values;
  if (std::find(values.begin(), values.end(), 0.0f) == values.end()) return all;
  const std::optional<double> lit = meter(image, [&](std::size_t i) { return values[i] == 0; });
  return std::max(lit.value_or(default_ev100), *all - emitters_over_ev);
}

}  // namespace

float auto_exposure_ev100(const Image& image) {
  const double ev100 = meter(image).value_or(default_ev100);
  return static_cast<float>(std::clamp(ev100, -12.0, 24.0));
}

float find_first_step(const Image& image) {
  const std::optional<double> ev100 = meter(image);
  if (!ev100) return 0;
  // The curves rise everywhere, so bisection finds the step.
  float dark = 0, seen = 1;
  for (int i = 0; i < 40; ++i) {
    const float middle = (dark + seen) / 2;
    const bool is_seen = 255 * tonemap::srgb_encode(tonemap::filmic_curve(middle)) >= 1;
    (is_seen ? seen : dark) = middle;
  }
  const float step = seen / tonemap::exposure_scale(static_cast<float>(*ev100));
  return std::isfinite(step) ? step : 0;
}

glm::vec3 mean_light(const Image& image) {
  const ImageLayer* emitters = image.layer("emitter");
  const std::vector<MeteredPixel> pixels =
      find_metered(image, [&](std::size_t i) { return !emitters || emitters->values[i] == 0; });
  glm::dvec3 sum(0);
  for (const MeteredPixel& pixel : pixels)
    for (int c = 0; c < 3; ++c)
      sum[c] += std::max(0.0, double{image.rgb[3 * pixel.index + std::size_t(c)]});
  return pixels.empty() ? glm::vec3(0) : glm::vec3(sum / double(pixels.size()));
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
