// The traffic of a city, on the streets of its map.
#pragma once

#include "formats/light_file_edit.h"
#include "tools/bake/city/city.h"
#include "tools/bake/progress.h"
#include "tools/traffic/traffic.h"

namespace nightcity::bake {

/// Makes the traffic of a night in model space, as `georeference` has it. Without a city model it
/// drives on a plane at height 0. A map without streets gives an empty set. Throws Error when there
/// are streets and the city has no CRS.
traffic::TrafficSet make_city_traffic(const City& city, const traffic::TrafficOptions& options,
                                      const Georeference& georeference,
                                      const ProgressSink& progress);

/// Returns the traffic as a light file takes it. The spans point into `traffic`.
TrafficAddition to_addition(const traffic::TrafficSet& traffic);

}  // namespace nightcity::bake
