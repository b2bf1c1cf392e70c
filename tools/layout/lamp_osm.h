// Placed lamps as an OSM file, to be looked at, mended in an editor and given back as [osm] files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <span>

#include "tools/lights/place_lamps.h"

namespace nightcity::layout {

/// One node a lamp: highway=street_lamp with height, light:luminous_flux (lumen), light:colour (kelvin),
/// light:direction (degrees from true north), ele, lit where the lamp has hours, and, over the street,
/// lamp_mount=suspended; `source` names the way or the mapped node. Ids are negative, as editors give them to
/// what is not yet in the map, and stay those of the lamps. Throws Error where the file cannot be written.
/// Lamps without a place on the Earth are left out; the number written.
std::size_t write_lamp_osm(const std::filesystem::path& path, std::span<const PlacedLamp> lamps,
                           const std::function<glm::dvec2(const glm::dvec2&)>& to_lon_lat);

}  // namespace nightcity::layout
