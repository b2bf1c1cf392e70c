// A camera's exposure for a picture in cd/m2, and the picture as a display then shows it.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "runtime/measure/image.h"
#include "shaders/tonemap.glsl.h"

namespace nightcity::measure {

/// The exposure of a picture that has no pixel to meter: that of a lit street, about 0.5 cd/m2.
constexpr float default_ev100 = 2.0f;

/// Returns the EV100 of a reflected-light meter with K = 12.5 (ISO 2720): log2(L * 100 / 12.5). L
/// is the geometric mean of the luminances, each weighted by itself, so that the dark area around a
/// few lit streets does not matter. The brightest fiftieth (lamps, fireflies) and pixels that are
/// not finite and positive are left out; when none remains, returns default_ev100. Where the
/// picture has a layer "emitter" (Renderer::sample_mean), lamps and windows that are seen directly
/// count only as far as that keeps them from being exposed more than 6 EV above the meter's value
/// for all: else a lit window beside the eye would leave the street black. The result is clamped to
/// -12 .. 24.
float auto_exposure_ev100(const Image& image);

/// Returns the grey, cd/m2, that shows as the first step above black of an 8-bit picture through
/// the default curve, at the exposure that auto_exposure_ev100 meters without its bounds: 1.2 % of
/// the luminance that is metered. 0 where no pixel can be metered, and beyond the range of floats.
float find_first_step(const Image& image);

/// Returns the mean light of the pixels that auto_exposure_ev100 meters, cd/m2 per channel, without
/// lamps and windows that are seen directly where the layer "emitter" tells them: what an eye
/// adapts its white to. 0 where there is no light.
glm::vec3 mean_light(const Image& image);

/// Converts "filmic", "reinhard" or "linear" to TONEMAP_*. Throws UsageError that lists the three.
std::uint32_t tone_curve_from_name(const std::string& name);
const char* tone_curve_name(std::uint32_t curve);

/// Exposes, maps each channel through `curve`, encodes as sRGB and rounds to 8 bits. NaN shows as
/// black.
Image8 to_display(const Image& image, float ev100, std::uint32_t curve = TONEMAP_FILMIC);

/// Does the same for one channel: `exposed` = luminance * tonemap::exposure_scale(ev100).
std::uint8_t to_code_value(float exposed, std::uint32_t curve);

}  // namespace nightcity::measure
