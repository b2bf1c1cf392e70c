// From the files of a city to prepared objects: each is read, placed in the city's frame, repaired,
// triangulated and passed on to every consumer.
#pragma once

#include <span>

#include "tools/bake/city/city_consumer.h"
#include "tools/bake/city/city_frames.h"
#include "tools/bake/city/ground_heights.h"
#include "tools/bake/progress.h"
#include "tools/bake/report/city_report.h"

namespace nightcity::bake {

/// Memory does not grow with the city, but for what the consumers keep. Objects over 100 km from
/// the city's first file and objects that an earlier file has brought are left out and counted.
/// Throws Error as the reader of the files does.
/// `heights`: of the ground that objects of a model without heights of its own stand on, as a map's
/// buildings do; null: objects have heights. Such an object stands on the lowest height below its
/// outlines, as OpenStreetMap counts the height of a building; one without any is left out.
CityReport read_prepared_objects(const CityInputs& inputs, CityFrames& frames,
                                 const GroundHeights* heights,
                                 std::span<CityConsumer* const> consumers,
                                 const ProgressSink& progress);

/// Returns whether `object` is of a kind that lies on the ground and every vertex of it has height
/// 0 exactly, as in the file: it was published without heights (PLATEAU's roads in LoD1).
bool lacks_heights(const city::CityObject& object);

}  // namespace nightcity::bake
