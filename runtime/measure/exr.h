// OpenEXR in and out: the picture in cd/m2 as R, G, B and every layer as "name.channel", 32-bit float, ZIP.
#pragma once

#include <filesystem>

#include "runtime/measure/image.h"

namespace nightcity {

/// Writes beside `path` and renames. The header says whiteLuminance = 1 cd/m2, Rec. 709 chromaticities and,
/// under "nightcity.", each known field of ImageInfo. Throws Error: a value that is not finite, a layer of
/// the wrong length or with a repeated or unusable name, a file that cannot be written.
void write_exr(const std::filesystem::path& path, const Image& image);

/// Reads any scanline or tiled OpenEXR with R, G and B (or Y alone) at full resolution, its display-less
/// extra channels as layers; a whiteLuminance other than 1 scales the colours to cd/m2. NaN and Inf come
/// through as they are: who measures refuses them. Throws Error on anything else, or wider or higher than
/// max_image_side.
Image read_exr(const std::filesystem::path& path);

}  // namespace nightcity
