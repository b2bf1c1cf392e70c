#include "runtime/measure/false_colour.h"

#include <fmt/format.h>
#include <stb/stb_easy_font.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "formats/error.h"
#include "shaders/tonemap.glsl.h"
#include "shaders/views.glsl.h"

namespace nightcity::measure {
namespace {

constexpr std::array<double, 3 * FALSE_COLOUR_STOPS> stops{FALSE_COLOURS};
constexpr std::array<double, 3 * SIGNED_COLOUR_STOPS> signed_stops{SIGNED_COLOURS};

// Returns the colour of a share, 0 .. 1, between evenly spaced ones.
template <std::size_t size>
std::array<std::uint8_t, 3> mix_stops(const std::array<double, size>& colours, double share) {
  const double at = std::clamp(share, 0.0, 1.0) * double(size / 3 - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(at), size / 3 - 2);
  std::array<std::uint8_t, 3> colour{};
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] = static_cast<std::uint8_t>(std::lround(
        std::lerp(colours[3 * low + c], colours[3 * low + 3 + c], at - static_cast<double>(low))));
  return colour;
}

void put(Image8& image, std::uint32_t x, std::uint32_t y,
         const std::array<std::uint8_t, 3>& colour) {
  if (x >= image.width || y >= image.height) return;
  std::copy(colour.begin(), colour.end(), &image.rgb[3 * (std::size_t{y} * image.width + x)]);
}

// stb_easy_font draws text as rectangles of whole pixels and needs no font file.
void write_text(Image8& image, double x, double y, std::string text) {
  struct Vertex {
    float x, y, z;
    unsigned char colour[4];
  };
  std::vector<Vertex> corners(text.size() * 80);
  const int quads = stb_easy_font_print(0, 0, text.data(), nullptr, corners.data(),
                                        static_cast<int>(corners.size() * sizeof(Vertex)));
  for (int q = 0; q < quads; ++q) {
    const Vertex& a = corners[4 * static_cast<std::size_t>(q)];
    const Vertex& b = corners[4 * static_cast<std::size_t>(q) + 2];
    for (float py = a.y; py < b.y; ++py)
      for (float px = a.x; px < b.x; ++px)
        if (x + double(px) >= 0 && y + double(py) >= 0)
          put(image, static_cast<std::uint32_t>(x + double(px)),
              static_cast<std::uint32_t>(y + double(py)), {255, 255, 255});
  }
}

double text_width(std::string text) {
  return stb_easy_font_width(text.data());
}

void draw_bar(Image8& image, std::uint32_t top, const ColourScale& scale) {
  constexpr std::uint32_t margin = 8, bar = 12;
  const std::uint32_t length = image.width > 2 * margin + 1 ? image.width - 2 * margin : 1;
  for (std::uint32_t x = 0; x < length; ++x)
    for (std::uint32_t y = 0; y < bar; ++y)
      put(image, margin + x, top + 4 + y, colour_at(double(x) / double(std::max(length - 1, 1u))));
  const double decades = std::log10(scale.highest / scale.lowest);
  double free_from = 0;  // so that no label covers another
  for (double decade = std::ceil(std::log10(scale.lowest) - 1e-9);
       decade <= std::log10(scale.highest) + 1e-9; ++decade) {
    const double share = (decade - std::log10(scale.lowest)) / decades;
    const double x = margin + share * (length - 1);
    for (std::uint32_t y = bar - 4; y < bar + 3; ++y)
      put(image, static_cast<std::uint32_t>(x), top + 4 + y, {255, 255, 255});
    std::string label = fmt::format("{:g} {}", std::pow(10.0, decade), scale.unit);
    const double left =
        std::clamp(x - text_width(label) / 2, 0.0, std::max(0.0, image.width - text_width(label)));
    if (left < free_from) continue;
    write_text(image, std::floor(left), top + 4 + bar + 6, label);
    free_from = left + text_width(label) + 6;
  }
}

}  // namespace

std::array<std::uint8_t, 3> colour_at(double share) {
  return mix_stops(stops, share);
}

std::array<std::uint8_t, 3> signed_colour_at(double share) {
  return mix_stops(signed_stops, (share + 1) / 2);
}

ColourScale fitting_scale(std::span<const float> values, std::string unit) {
  std::vector<float> positive;
  for (const float v : values)
    if (v > 0 && std::isfinite(v)) positive.push_back(v);
  if (positive.empty()) return {0.01, 100, std::move(unit)};
  const auto quantile = [&](double share) {
    const auto at =
        positive.begin() + static_cast<std::ptrdiff_t>(share * double(positive.size() - 1));
    std::nth_element(positive.begin(), at, positive.end());
    return std::log10(double(*at));
  };
  const double low = std::floor(quantile(0.01)),
               high = std::max(std::ceil(quantile(0.99)), low + 1);
  return {std::pow(10.0, low), std::pow(10.0, high), std::move(unit)};
}

Image8 false_colour(std::span<const float> values, std::uint32_t width, std::uint32_t height,
                    const ColourScale& scale) {
  if (values.size() != std::size_t{width} * height)
    throw Error("false colour", "as many values as pixels are needed");
  if (!(scale.lowest > 0 && scale.highest > scale.lowest))
    throw Error("false colour", "a scale goes from above 0 upwards");
  Image8 image{width, height + scale_bar_height, {}};
  image.rgb.resize(3 * std::size_t{image.width} * image.height);
  const double decades = std::log10(scale.highest / scale.lowest);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const double value = double(values[std::size_t{y} * width + x]);
      // NaN is black, too.
      if (value > 0) put(image, x, y, colour_at(std::log10(value / scale.lowest) / decades));
    }
  draw_bar(image, height, scale);
  return image;
}

std::vector<float> luminance_of(const Image& image) {
  std::vector<float> values(image.pixels());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] =
        tonemap::luminance_709(image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2]);
  return values;
}

std::vector<float> illuminance_of(const Image& image, Illumination part) {
  const auto layer = [&](const char* name) -> const std::vector<float>& {
    const ImageLayer* found = image.layer(name);
    if (!found) throw Error("illuminance", std::string("the picture has no layer ") + name);
    return found->values;
  };
  const auto& albedo = layer("albedo");
  std::vector<const std::vector<float>*> parts;
  if (part != Illumination::indirect)
    for (const char* name : {"direct_lamps", "direct_windows", "direct_vehicles", "sky"})
      parts.push_back(&layer(name));
  if (part != Illumination::direct) parts.push_back(&layer("indirect"));
  // Layers hold what reaches the eye, less what the air in front of a surface takes.
  const ImageLayer* air = image.layer("transmittance");
  std::vector<float> values(image.pixels());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float passed = air ? air->values[i] : 1.0f;
    std::array<float, 3> lux{};
    for (std::size_t c = 0; c < 3; ++c) {
      float reflected = 0;
      for (const auto* values_of_part : parts) reflected += (*values_of_part)[3 * i + c];
      const float base = albedo[3 * i + c] * passed;
      lux[c] = base > 0 ? std::numbers::pi_v<float> * reflected / base : 0.0f;
    }
    values[i] = tonemap::luminance_709(lux[0], lux[1], lux[2]);
  }
  return values;
}

}  // namespace nightcity::measure
