// Makes blocks of buildings that are published as a footprint and a height.
#pragma once

#include "tools/city/city_model.h"

namespace nightcity::city {

/// Returns whether the object is a building that is nothing but level polygons of LoD0.
bool is_flat_building(const CityObject& object);

/// Replaces a flat building's polygons by blocks of its measured height, without measure changing
/// nothing and returning false: floor, roof and walls, holes as courtyards. A footprint lies at the
/// block's foot; a roof edge at its top, or at its foot where the file gives it height 0, as files
/// without heights do. Where there are footprints, roof edges are left out. `height_unit_m`: metres
/// in the unit of the object's heights.
bool extrude_flat_building(CityObject& object, double height_unit_m);

}  // namespace nightcity::city
