// What lit windows look like: one quad each, batched by tile and brightness.
#pragma once

#include <cstdint>
#include <span>

#include "formats/georeference.h"
#include "formats/scene_file.h"
#include "tools/lights/windows.h"

namespace nightcity {

/// Adds the windows as nodes of kind "window" that cast no shadow (their quads lie where their light starts).
/// Each vertex names its light: window i is light `first_light` + i of city.lights. Materials hold the
/// luminance to a quarter of a stop and the colour to 250 K, which is for the eye of other programs; the
/// lights themselves are exact.
void add_window_models(SceneWriter& writer, std::span<const LitRectangle> windows, std::uint32_t first_light,
                       const Georeference& georeference, double tile_m);

}  // namespace nightcity
