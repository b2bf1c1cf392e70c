#include "formats/colour.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>

#include "formats/srgb.h"

namespace nightcity {

glm::dvec2 planckian_xy(double kelvin) {
  const double t = std::clamp(kelvin, 1000.0, 15000.0);
  const double u = (0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t * t) /
                   (1 + 8.42420235e-4 * t + 7.08145163e-7 * t * t);
  const double v = (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t * t) /
                   (1 - 2.89741816e-5 * t + 1.61456053e-7 * t * t);
  const double scale = 2 * u - 8 * v + 4;  // CIE 1960 UCS back to 1931
  return {3 * u / scale, 2 * v / scale};
}

glm::vec3 rec709_from_xy(const glm::dvec2& xy) {
  const double x = xy.x / xy.y, z = (1 - xy.x - xy.y) / xy.y;  // of luminance Y = 1
  // Inverse of the primaries' matrix of ITU-R BT.709-6 with white D65.
  glm::dvec3 rgb(3.2409699419 * x - 1.5373831776 - 0.4986107603 * z,
                 -0.9692436363 * x + 1.8759675015 + 0.0415550574 * z,
                 0.0556300797 * x - 0.2039769589 + 1.0569715142 * z);
  rgb = glm::max(rgb, glm::dvec3(0));
  return glm::vec3(rgb / (0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b));
}

std::optional<glm::vec3> rec709_from_hex(std::string_view text) {
  std::string doubled = "#";
  if (text.size() == 4)  // "#fa0" is "#ffaa00"
    for (const char digit : text.substr(1)) doubled += {digit, digit};
  if (text.size() == 4 && text[0] == '#') text = doubled;
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  std::uint32_t rgb = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + 1, end, rgb, 16);
  if (error != std::errc() || stop != end) return std::nullopt;
  return rec709_from_rgb(rgb);
}

std::optional<glm::vec3> rec709_from_rgb(std::uint32_t rgb) {
  glm::dvec3 linear;
  for (int channel = 0; channel < 3; ++channel)
    linear[channel] = linear_from_srgb((rgb >> (16 - 8 * channel) & 255u) / 255.0);
  const double luminance = 0.2126 * linear.r + 0.7152 * linear.g + 0.0722 * linear.b;
  if (luminance <= 0) return std::nullopt;
  return glm::vec3(linear / luminance);
}

std::string to_hex(const glm::vec3& rec709) {
  const double brightest = std::max({rec709.r, rec709.g, rec709.b});
  std::string text = "#";
  for (int channel = 0; channel < 3; ++channel) {
    const double encoded = srgb_from_linear(rec709[channel] / brightest);
    const auto value = static_cast<unsigned>(std::lround(255 * encoded));
    for (const unsigned digit : {value / 16, value % 16}) text += "0123456789abcdef"[digit];
  }
  return text;
}

}  // namespace nightcity
