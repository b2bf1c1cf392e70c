// Parking lanes along a street: where they are interrupted, and the paint between their bays.
#pragma once

#include <glm/vec2.hpp>
#include <utility>
#include <vector>

#include "tools/ground_cover/junctions.h"
#include "tools/ground_cover/measured_line.h"
#include "tools/ground_cover/painter.h"
#include "tools/roads/carriageway.h"

namespace nightcity::ground_cover {

/// Returns the stretches of a way along which cars park, by distances from its start: all of it but
/// its junctions and 5 m before them (StVO, section 12 (3)), and the width of entrances. `line`:
/// the way's points in the frame.
std::vector<std::pair<double, double>> find_parking_stretches(const osm::OsmWay& way,
                                                              const MeasuredLine& along,
                                                              std::size_t points,
                                                              const Junctions& junctions);

/// Adds the lines between the bays of a lane that is marked, and along it where it is a part of the
/// carriageway. `on_the_left`: the side of the road that vehicles keep to.
void add_bay_lines(const osm::OsmWay& way, const roads::Carriageway& road,
                   const std::vector<glm::dvec2>& line, const Junctions& junctions,
                   bool on_the_left, Painter& painter);

}  // namespace nightcity::ground_cover
