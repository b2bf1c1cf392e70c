// The bodies of vehicles in city.glb: one node for each kind, one instance for each vehicle.
#pragma once

#include "formats/scene_writer.h"
#include "tools/traffic/traffic.h"

namespace nightcity::bake {

/// Adds the bodies of the kinds of vehicle that have a trip, as nodes of kind "vehicle". They are
/// where the trips have them at `t` seconds since noon; a kind that is not on the road at that time
/// is where its first trip begins.
void add_vehicle_models(SceneWriter& writer, const traffic::TrafficSet& traffic, double t);

}  // namespace nightcity::bake
