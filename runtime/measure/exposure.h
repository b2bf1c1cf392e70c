// A camera's exposure for a picture in cd/m2, and the picture as it then shows on a display.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/measure/image.h"
#include "shaders/tonemap.glsl.h"

namespace nightcity {

/// The exposure of a picture without anything to meter by: a lit street, about 0.5 cd/m2.
constexpr float default_ev100 = 2.0f;

/// EV100 that a reflected-light meter with K = 12.5 (ISO 2720) gives where the light of a night picture is:
/// log2(L * 100 / 12.5), L the geometric mean of the luminances, each weighted by itself, so that the dark
/// expanse around a few lit streets has no say; the brightest fiftieth (lamps, fireflies) is left out.
/// Non-finite and non-positive pixels are left out too; with none left, default_ev100. Clamped to -12 .. 24.
float auto_exposure_ev100(const Image& image);

/// "filmic", "reinhard", "linear" to TONEMAP_*; throws UsageError naming the three.
std::uint32_t tone_curve_from_name(const std::string& name);
const char* tone_curve_name(std::uint32_t curve);

/// Exposes, maps each channel through `curve`, encodes as sRGB and rounds to 8 bits. NaN shows as black.
Image8 to_display(const Image& image, float ev100, std::uint32_t curve = TONEMAP_FILMIC);

/// One channel of that: `exposed` = luminance * tonemap::exposure_scale(ev100).
std::uint8_t to_code_value(float exposed, std::uint32_t curve);

}  // namespace nightcity
