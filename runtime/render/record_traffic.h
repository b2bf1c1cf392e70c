// The records of pixels (shaders/frame.h) that the passes of a frame have to move.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "runtime/render/settings.h"

namespace nightcity::render {

/// Returns, by the name of each step (FrameStep), the bytes of a pixel that it has to read or write
/// in memory at least, in a frame with history that all pixels sample: every record once, however
/// many pixels ask for it. What rays and samples of lights read comes on top: it depends on what
/// caches keep. Steps that have no such bound are not named: those over vehicles and over cells of
/// the irradiance cache, air, and the reference; at half rate none is.
std::map<std::string, std::size_t> find_record_bytes(const RenderSettings& settings);

}  // namespace nightcity::render
