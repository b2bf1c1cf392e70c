// Writes placed lamps to an OSM file, which can be edited and given back as [osm] files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <span>

#include "tools/lights/place_lamps.h"

namespace nightcity::layout {

/// Writes one node for each lamp and returns their number. A node has highway=street_lamp, height,
/// light:luminous_flux (lumen), light:colour (kelvin or #rrggbb), light:direction (degrees from
/// true north), ele, lit if the lamp has hours, lamp_mount=suspended if it hangs over the street,
/// and `source`, which names the way or the mapped node. Ids are negative, as editors write them
/// for nodes that are not yet in the map, and follow from the lamps' ids. Lamps without a place on
/// the Earth are left out. Throws Error if the file cannot be written.
std::size_t write_lamp_osm(const std::filesystem::path& path,
                           std::span<const lights::PlacedLamp> lamps,
                           const std::function<glm::dvec2(const glm::dvec2&)>& to_lon_lat);

}  // namespace nightcity::layout
