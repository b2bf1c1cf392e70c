// On which side of the road a part of the world drives, and how fast where no limit is signed.
#pragma once

#include <glm/vec2.hpp>

#include "tools/roads/road_class.h"

namespace nightcity::traffic {

enum class Side { right, left };

struct Country {
  const char* name;
  Side side;
  // Speed limits in km/h where none is signed: the first two in towns, the others outside them.
  double residential_kmh, main_kmh, trunk_kmh, motorway_kmh;
};

/// Returns the country at a place in WGS 84 degrees. Countries are boxes, so the answer is wrong
/// within some kilometres of a few borders; a recipe's `side` overrides it. Where nothing is known:
/// right, 50 km/h.
const Country& country_at(const glm::dvec2& lon_lat);

/// Returns the speed limit in km/h of a class of road where no limit is signed.
double default_speed_kmh(const roads::RoadClass& road, const Country& country);

}  // namespace nightcity::traffic
