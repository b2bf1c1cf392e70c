// Turns the streets of a city model into ways of a map, so that lamps and traffic need no map.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tools/city/city_reader.h"
#include "tools/osm/osm_data.h"
#include "tools/streets/chordal_axis.h"
#include "tools/streets/road_surfaces.h"

namespace nightcity::streets {

struct StreetWays {
  std::vector<osm::OsmWay> ways;     // two-way, with the tags highway and width
  std::map<std::string, double> km;  // by highway
  double km_by_code = 0;  // length whose class comes from a code; otherwise from the width
  std::size_t junctions = 0, ends = 0;
};

/// Returns the streets of these surfaces as ways. `to_lon_lat` is the inverse of the `to_frame`
/// used by the readers of the ways. Throws Error as road_outline and chordal_axis do.
StreetWays find_street_ways(const RoadSurfaces& roads,
                            const std::function<glm::dvec2(const glm::dvec2&)>& to_lon_lat,
                            int max_crossings = city::PolygonLimits{}.max_crossings,
                            int max_points = default_max_road_points);

}  // namespace nightcity::streets
