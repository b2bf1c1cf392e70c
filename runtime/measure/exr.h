// OpenEXR in and out: the picture in cd/m2 as R, G, B and every layer as "name.channel", 32-bit
// float, ZIP.
#pragma once

#include <filesystem>

#include "runtime/measure/image.h"

namespace nightcity::measure {

/// Writes a temporary file beside `path` and renames it. The header holds whiteLuminance = 1 cd/m2,
/// Rec. 709 chromaticities and, under "nightcity.", each known field of ImageInfo. Throws Error
/// when a value is not finite, a layer has a wrong length or a repeated or unusable name, or the
/// file cannot be written.
void write_exr(const std::filesystem::path& path, const Image& image);

/// Reads any scanline or tiled OpenEXR with R, G and B (or Y alone) at full resolution, and its
/// other channels as layers. A whiteLuminance other than 1 scales the colours to cd/m2. NaN and
/// infinity are kept; the metrics refuse them. Throws Error on any other file and on sides above
/// max_image_side.
Image read_exr(const std::filesystem::path& path);

}  // namespace nightcity::measure
