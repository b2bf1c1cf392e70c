// The ground to the horizon in city.glb.
#pragma once

#include <cstdint>

#include "formats/georeference.h"
#include "formats/scene_writer.h"
#include "tools/bake/report/scene_report.h"
#include "tools/terrain/outline.h"

namespace nightcity::bake {

/// Adds the surface around the ground with this outline (terrain::make_horizon) as a node of kind
/// "horizon", of the writer's `material`. It casts no shadow: no light stands beyond it. A ground
/// whose outline crosses itself too often, or has over a million vertices, gets none, which is
/// reported.
HorizonReport add_horizon_model(SceneWriter& writer, const terrain::Outline& outline,
                                std::uint32_t material, const Georeference& georeference);

}  // namespace nightcity::bake
