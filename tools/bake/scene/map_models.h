// The barriers and the flights of steps of the map in the scene.
#pragma once

#include "tools/bake/city/city.h"
#include "tools/bake/report/barrier_report.h"
#include "tools/bake/report/steps_report.h"
#include "tools/bake/scene/scene_tiles.h"

namespace nightcity::bake {

/// Adds the barriers on the ground's `extent` to the tiles, and what they are to `report`.
void add_barrier_models(const City& city, const terrain::Extent& extent, SceneTiles& tiles,
                        BarriersReport& report);

/// Does the same with the flights of steps.
void add_step_models(const City& city, const terrain::Extent& extent, SceneTiles& tiles,
                     FlightsReport& report);

}  // namespace nightcity::bake
