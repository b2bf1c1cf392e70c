// Reads a ring that is made of curves (gml:Ring): straight pieces as they are, circular arcs as
// chords.
#pragma once

#include <pugixml.hpp>
#include <string_view>

#include "tools/citygml/rings.h"

namespace nightcity::citygml {

/// Returns whether a ring's element holds curves instead of vertices.
bool is_curve_ring(std::string_view local);

/// Appends the vertices of a gml:Ring (GML 3.1.1, 10.5.4) to `ring`, consecutive duplicates left
/// out: LineString, LineStringSegment, Arc, ArcString and Circle, in Curve, CompositeCurve and
/// OrientableCurve. Arcs become chords of 3 degrees, which lose 0.05 percent of a disc's area.
/// Returns the fault, with which `ring` is unspecified: `unknown_curve` for splines, arcs by centre
/// and curves that an xlink names. `dimension` as for read_ring.
RingFault read_curves(const pugi::xml_node& ring_element, int dimension, city::Ring& ring);

}  // namespace nightcity::citygml
