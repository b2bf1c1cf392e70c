// Luminaire profiles as files that other programs read.
#pragma once

#include <span>
#include <string>

#include "formats/light.h"

namespace nightcity::exports {

/// The flux of the lamp in the files that to_ies_text writes, lm.
constexpr double ies_flux_lm = 1000;

/// Returns a profile of a light file as ANSI/IESNA LM-63-2002, type C, absolute photometry. What is
/// dark beyond the profile's last angle is dark in the file, too, which ends at 90 or 180 degrees.
std::string to_ies_text(const LightProfile& profile, std::span<const float> profile_data);

}  // namespace nightcity::exports
