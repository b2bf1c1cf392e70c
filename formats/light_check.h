// What makes a light or a profile unfit for a file: one check for writers, readers and verify().
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "formats/light.h"

namespace nightcity {

/// Why `light` may not stand in a file with `profile_count` profiles; empty when it may.
std::optional<std::string> light_fault(const Light& light, std::size_t profile_count);

/// Why `profile` may not stand in a file whose profile data has `data_size` floats; empty when it may.
std::optional<std::string> profile_fault(const LightProfile& profile, std::size_t data_size);

}  // namespace nightcity
