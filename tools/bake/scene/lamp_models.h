// Street lamps in city.glb: post, arm, housing and a luminous ball, of a few triangles each,
// instanced.
#pragma once

#include <span>

#include "formats/georeference.h"
#include "formats/scene_writer.h"
#include "tools/lights/place_lamps.h"

namespace nightcity::bake {

/// Adds the lamps to `writer` as instanced nodes of kind "lamp". Posts and arms cast shadows.
/// Housings and luminous balls do not, because the profile of the luminaire already includes the
/// effect of its housing. The balls emit the luminance that a sphere of the lamp's radius needs for
/// its flux, L = flux / (4 pi^2 r^2), and name their light: lamp i is light i of city.lights.
/// `post_material` is a material of `writer`.
void add_lamp_models(SceneWriter& writer, std::span<const lights::PlacedLamp> lamps,
                     const Georeference& georeference, std::uint32_t post_material);

}  // namespace nightcity::bake
