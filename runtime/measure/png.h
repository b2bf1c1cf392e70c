// 8-bit sRGB PNG in and out.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "runtime/measure/image.h"

namespace nightcity {

/// Keyword (Latin-1, 1 to 79 characters, as PNG has it) and text, stored uncompressed.
using PngText = std::vector<std::pair<std::string, std::string>>;

/// How a picture was made as PNG text: "Software", "Estimator", "Frames", ... for what `info` knows.
PngText png_text(const ImageInfo& info);

/// Writes beside `path` and renames; marked as sRGB. Throws Error.
void write_png(const std::filesystem::path& path, const Image8& image, const PngText& text = {});

/// Reads any PNG as 8-bit sRGB over black. Throws Error: missing, truncated, not a PNG, larger than
/// max_image_side.
Image8 read_png(const std::filesystem::path& path);

}  // namespace nightcity
