// Checks of lights and profiles: the same for writers, readers and verify().
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "formats/light.h"

namespace nightcity {

/// The smallest flux that single precision divides by distances and areas without loss, lm.
constexpr float min_flux_lm = 1e-30f;

/// Returns why `light` may not be in a file with `profile_count` profiles; empty if it may.
std::optional<std::string> light_fault(const Light& light, std::size_t profile_count);

/// Returns why `profile` may not be in a file whose profile data has `data_size` floats; empty if
/// it may.
std::optional<std::string> profile_fault(const LightProfile& profile, std::size_t data_size);

/// The largest distance of a profile's integral from 1 (SPEC.md, section 3.4).
constexpr double profile_integral_tolerance = 0.005;

/// Returns the integral over the sphere of a profile's bilinear interpolant, which the flux of its
/// lights is multiplied by. The profile must be without fault.
double integrate_profile(const LightProfile& profile, std::span<const float> data);

/// Returns why the integral of `profile` is not 1 within the tolerance; empty if it is.
std::optional<std::string> profile_integral_fault(const LightProfile& profile,
                                                  std::span<const float> data);

}  // namespace nightcity
