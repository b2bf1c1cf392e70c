// What vehicles look like: one node a kind, an instance each vehicle.
#pragma once

#include "formats/scene_writer.h"
#include "tools/traffic/traffic.h"

namespace nightcity {

/// Adds the bodies of the kinds of vehicle that have a trip, as nodes of kind "vehicle". They stand
/// where they are at `t` seconds since noon; a kind that is not on the road then stands where its
/// first trip begins.
void add_vehicle_models(SceneWriter& writer, const traffic::TrafficSet& traffic, double t);

}  // namespace nightcity
