// Reads the coordinates of a GML ring: posList, pos, coordinates, coord, pointProperty. Text that comments
// or CDATA cut in pieces is read whole.
#pragma once

#include <cstdint>
#include <pugixml.hpp>
#include <vector>

#include "tools/city/city_model.h"

namespace nightcity::citygml {

enum class RingFault : std::uint8_t {
  none,
  no_coordinates,  // no element that holds any
  not_numbers,     // letters, comma decimals, NaN, infinity
  wrong_count,     // not a multiple of the dimension
  too_short,       // fewer than three distinct places in a row
  unknown_curve,   // made of curves that are not read
};
const char* name_of(RingFault fault);

/// The parts of a document that pugixml must keep: resolved entities and CDATA.
constexpr unsigned gml_parse_flags = pugi::parse_escapes | pugi::parse_cdata;

/// Fills `ring` from a LinearRing, or a Ring of curves (curves.h), and returns its fault,
/// with which `ring` is unspecified. `dimension`: srsDimension given by an ancestor, 0 = none
/// (then 3, or 2 where the list is closed in the plane alone). Vertices of two coordinates get height 0. The closing vertex and consecutive
/// duplicates are left out.
RingFault read_ring(const pugi::xml_node& ring_element, int dimension, city::Ring& ring);

/// Returns the dimension that an element says (srsDimension), else `inherited`; 0 = none.
int find_dimension(const pugi::xml_node& element, int inherited);

/// Appends the vertices that the element's children hold, consecutive duplicates left out.
RingFault read_vertices(const pugi::xml_node& element, int dimension, city::Ring& vertices);

/// Appends every number in the element's text. Returns false when something in it is no finite
/// number.
bool read_numbers(const pugi::xml_node& element, std::vector<double>& numbers);

}  // namespace nightcity::citygml
