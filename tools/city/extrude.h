// Makes blocks of buildings that are published as a footprint and a height.
#pragma once

#include <optional>

#include "tools/city/city_model.h"

namespace nightcity::city {

/// Returns whether the object is a building that is nothing but plans of LoD0: polygons that are
/// level or nearly so.
bool is_flat_building(const CityObject& object);

/// Returns how high a building is by its measured height, else by its storeys: these times the mean
/// of the heights that are stated of them, or 3 m, as maps' levels count. Empty without either.
std::optional<double> find_block_height_m(const CityObject& object);

/// Returns how far the highest roof edge of a flat building lies above its lowest footprint, in the
/// unit of its heights. Empty where it lacks one of them, or they lie in one plane.
std::optional<double> find_roof_span(const CityObject& object);

/// Replaces a flat building's polygons by blocks of its measured height, else of its roof's span,
/// else of its storeys: floor, roof and walls, holes as courtyards. Without any it changes nothing
/// and returns false. A footprint's lowest corner lies at the block's foot; a roof edge's highest
/// at its top, or at its foot where the file gives it height 0, as files without heights do. Where
/// there are footprints, roof edges are left out. `height_unit_m`: metres in the unit of the
/// object's heights.
bool extrude_flat_building(CityObject& object, double height_unit_m);

}  // namespace nightcity::city
