// From scene luminance to a display's code value: exposure, tone curves, sRGB transfer. Included by
// C++ and GLSL, so that the window, the PNG and the 8-bit error of `nightview compare` are one
// function.
#ifndef NIGHTCITY_SHADERS_TONEMAP_GLSL_H
#define NIGHTCITY_SHADERS_TONEMAP_GLSL_H

#ifdef __cplusplus
#include <cmath>
#include <cstdint>
#define TONEMAP_FUNCTION inline
namespace nightcity::tonemap {
using std::exp2;
using std::pow;
using uint = std::uint32_t;
#else
#define TONEMAP_FUNCTION
#endif

// Curves by name. Each takes exposed linear light (1 = the luminance that saturates the sensor) to
// display light, 0..1.
#define TONEMAP_LINEAR 0u  // clip at 1: proportional, for measuring
#define TONEMAP_REINHARD \
  1u  // x / (1 + x), with x = REINHARD_WHITE reaching 1: keeps lamps apart from each other
#define TONEMAP_FILMIC 2u  // toe and shoulder, deep blacks: the default

// The highest luminance, in exposed units, that Reinhard's curve keeps below white (his L_white).
#define REINHARD_WHITE 16.0f

/// Returns the exposed value of 1 cd/m2 at `ev100`: 1 / L_max, L_max = 78 / (100 q) * 2^EV100 = 1.2
/// * 2^EV100 cd/m2 with the lens factor q = 0.65 (ISO 12232, saturation-based speed).
TONEMAP_FUNCTION float exposure_scale(float ev100) {
  return 1.0f / (1.2f * exp2(ev100));
}

/// Returns the luminance of linear Rec. 709 light (ITU-R BT.709-6, 3.2).
TONEMAP_FUNCTION float luminance_709(float r, float g, float b) {
  return 0.2126f * r + 0.7152f * g + 0.0722f * b;
}

/// Reinhard, Stark, Shirley, Ferwerda, "Photographic tone reproduction for digital images", 2002,
/// eq. 4.
TONEMAP_FUNCTION float reinhard_curve(float x) {
  float y = x * (1.0f + x / (REINHARD_WHITE * REINHARD_WHITE)) / (1.0f + x);
  return y < 1.0f ? y : 1.0f;
}

/// Narkowicz, "ACES filmic tone mapping curve", 2016: a rational fit of the ACES reference
/// rendering for sRGB displays.
TONEMAP_FUNCTION float filmic_curve(float x) {
  // Beyond this the fit only says "white"; without the limit x * x overflows to Inf / Inf for a
  // lamp seen directly.
  float limited = x < 1.0e4f ? x : 1.0e4f;
  float y = limited * (2.51f * limited + 0.03f) / (limited * (2.43f * limited + 0.59f) + 0.14f);
  return y < 1.0f ? y : 1.0f;
}

/// Returns one channel of exposed linear light through `curve`; negative light counts as none.
TONEMAP_FUNCTION float tone_curve(uint curve, float exposed) {
  float x = exposed > 0.0f ? exposed : 0.0f;
  if (curve == TONEMAP_FILMIC) return filmic_curve(x);
  if (curve == TONEMAP_REINHARD) return reinhard_curve(x < 1.0e4f ? x : 1.0e4f);
  return x < 1.0f ? x : 1.0f;
}

/// Converts display light 0..1 to an sRGB code value 0..1 (IEC 61966-2-1).
TONEMAP_FUNCTION float srgb_encode(float x) {
  return x <= 0.0031308f ? 12.92f * x : 1.055f * pow(x, 1.0f / 2.4f) - 0.055f;
}

#ifdef __cplusplus
}  // namespace nightcity::tonemap
#endif
#undef TONEMAP_FUNCTION

#endif
