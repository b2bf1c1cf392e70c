// Checks of lights and profiles: the same for writers, readers and verify().
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "formats/light.h"

namespace nightcity {

/// Returns why `light` may not be in a file with `profile_count` profiles; empty if it may.
std::optional<std::string> light_fault(const Light& light, std::size_t profile_count);

/// Returns why `profile` may not be in a file whose profile data has `data_size` floats; empty if
/// it may.
std::optional<std::string> profile_fault(const LightProfile& profile, std::size_t data_size);

}  // namespace nightcity
