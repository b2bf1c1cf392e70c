// Puts a light's record into words that other programs show.
#pragma once

#include <string>

#include "formats/light_file.h"

namespace nightcity::exports {

/// Returns "17:30-23:00, 05:15-06:45", "always", or "never": local time of one night.
std::string describe_hours(const LightFile& file, const Light& light);

/// Returns "position tag, height rule, flux inventory, ...".
std::string describe_provenance(const LightProvenance& from);

/// Returns the colour as sRGB, "#ffb46b": its brightest channel is 255.
std::string to_hex_colour(const Light& light);

}  // namespace nightcity::exports
