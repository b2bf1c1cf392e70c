// Colours with a shared exponent: three 9-bit mantissas, one 5-bit exponent
// (EXT_texture_shared_exponent).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

namespace nightcity {

/// Returns the luminance of a linear Rec. 709 colour (ITU-R BT.709-6, item 3.2).
inline float luminance(const glm::vec3& rgb) {
  return 0.2126f * rgb.x + 0.7152f * rgb.y + 0.0722f * rgb.z;
}

/// Returns a colour packed into 32 bits: red in the low bits, the exponent (bias 15) in the top
/// five. Values above 65408 are clamped; negative values and NaN become 0. The relative error of
/// the largest channel is at most 2^-9.
inline std::uint32_t encode_rgb9e5(const glm::vec3& rgb) {
  static constexpr float max_value = 65408.0f;  // 511/512 * 2^16
  const auto clean = [](float v) { return v > 0 ? std::min(v, max_value) : 0.0f; };
  const float r = clean(rgb.x), g = clean(rgb.y), b = clean(rgb.z);
  const float largest = std::max({r, g, b});
  if (largest == 0) return 0;
  // As it is stored: value = mantissa * 2^(exponent - 15 - 9).
  int exponent = std::max(-16, std::ilogb(largest)) + 16;
  // The largest channel may round up to one more bit than a mantissa has.
  if (std::lround(std::ldexp(largest, 24 - exponent)) == 512) ++exponent;
  const auto mantissa = [exponent](float v) {
    return static_cast<std::uint32_t>(std::lround(std::ldexp(v, 24 - exponent)));
  };
  return mantissa(r) | mantissa(g) << 9 | mantissa(b) << 18 |
         static_cast<std::uint32_t>(exponent) << 27;
}

/// Returns the colour that encode_rgb9e5 packed.
inline glm::vec3 decode_rgb9e5(std::uint32_t packed) {
  const int exponent = static_cast<int>(packed >> 27) - 24;
  const auto channel = [exponent](std::uint32_t mantissa) {
    return std::ldexp(static_cast<float>(mantissa & 511u), exponent);
  };
  return {channel(packed), channel(packed >> 9), channel(packed >> 18)};
}

}  // namespace nightcity
