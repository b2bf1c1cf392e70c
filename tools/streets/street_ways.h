// Streets of a city model as ways of a map: what lays lamps along streets and what drives on them then needs
// no map.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tools/osm/osm_data.h"
#include "tools/streets/road_surfaces.h"

namespace nightcity::streets {

struct StreetWays {
  std::vector<OsmWay> ways;          // with highway and width, two-way
  std::map<std::string, double> km;  // by highway
  double km_by_code = 0;             // where a code told the class; else the width did
  std::size_t junctions = 0, ends = 0;
};

/// `to_lon_lat` turns E, N into what `to_frame` of those who read the ways turns back.
StreetWays street_ways(const RoadSurfaces& roads,
                       const std::function<glm::dvec2(const glm::dvec2&)>& to_lon_lat);

}  // namespace nightcity::streets
