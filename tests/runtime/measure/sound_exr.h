// Checks that hold for every OpenEXR picture, broken or not: for the fuzz target and the test of
// its corpus.
#pragma once

#include <filesystem>
#include <string>

#include "formats/error.h"
#include "runtime/measure/exr.h"
#include "runtime/measure/limits.h"

namespace nightcity::test {

/// Returns what is wrong with how the picture is read; "" where it is sound, or refused with a
/// reason.
inline std::string find_fault_of_exr(const std::filesystem::path& path) {
  try {
    const measure::Image image = measure::read_exr(path);
    if (image.width < 1 || image.height < 1 || image.width > measure::max_image_side ||
        image.height > measure::max_image_side)
      return "the size";
    if (image.rgb.size() != 3 * image.pixels()) return "the number of values";
    for (const measure::ImageLayer& layer : image.layers)
      if (layer.channels.empty() || layer.values.size() != layer.channels.size() * image.pixels())
        return "the number of values of a layer";
  } catch (const Error& error) {
    if (std::string(error.what()).empty()) return "an error without words";
  }
  return "";
}

}  // namespace nightcity::test
