// Bodies in city.glb that carry signs, or that are floodlit where the model shows nothing.
#pragma once

#include <cstdint>
#include <span>

#include "formats/georeference.h"
#include "formats/scene_writer.h"
#include "tools/map_lights/place_map_lights.h"

namespace nightcity::bake {

/// Adds boxes and columns as instanced nodes of kind "sign", which cast shadows. `material` is one
/// of `writer`.
void add_sign_bodies(SceneWriter& writer, std::span<const map_lights::Body> bodies,
                     const Georeference& georeference, std::uint32_t material);

}  // namespace nightcity::bake
