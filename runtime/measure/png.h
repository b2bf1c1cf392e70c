// Reads and writes PNG as 8-bit sRGB.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "runtime/measure/image.h"

namespace nightcity::measure {

/// PNG text entries: keyword (Latin-1, 1 to 79 characters) and text, stored uncompressed.
using PngText = std::vector<std::pair<std::string, std::string>>;

/// Returns the known fields of `info` as PNG text: "Software", "Estimator", "Frames", ...
PngText png_text(const ImageInfo& info);

/// Writes a temporary file beside `path`, marked as sRGB, and renames it. Throws Error.
void write_png(const std::filesystem::path& path, const Image8& image, const PngText& text = {});

/// Reads any PNG as 8-bit sRGB over black. Throws Error when the file is missing, truncated, no
/// PNG, or has a side above max_image_side.
Image8 read_png(const std::filesystem::path& path);

}  // namespace nightcity::measure
