// A rendered picture in memory: luminance per channel, what else was seen in each pixel, and how it was made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nightcity {

/// What else a pixel knows: "albedo" with channels R, G, B; "depth" with Z. Whole numbers are exact up to
/// 2^24.
struct ImageLayer {
  std::string name;                   // no dot; "" would be the picture itself
  std::vector<std::string> channels;  // names without the layer's: "R", "G", "B" or "X", "Y" or "Z"
  std::vector<float> values;  // width * height * channels.size(), pixel by pixel, row 0 on top
};

/// How a picture was made; travels with it, so that no mode that changes its meaning can hide.
struct ImageInfo {
  std::string estimator;         // "" = not known (a foreign file)
  std::uint32_t frames = 0;      // frames accumulated; 0 = not known
  std::uint32_t candidates = 0;  // light candidates a pixel and frame; 0 = not known or not asked
  std::uint32_t neighbours = 0;  // reused neighbours a pixel and frame
  std::uint64_t seed = 0;
  std::optional<float> ev100;  // exposure a viewer should start with
  std::string device;          // the Vulkan device's own name
};

/// Linear Rec. 709 RGB in cd/m2.
struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<float> rgb;  // 3 * width * height, row 0 on top
  std::vector<ImageLayer> layers;
  ImageInfo info;

  std::size_t pixels() const { return std::size_t{width} * height; }
  /// The layer of that name, or nullptr.
  const ImageLayer* layer(const std::string& name) const {
    for (const ImageLayer& candidate : layers)
      if (candidate.name == name) return &candidate;
    return nullptr;
  }
};

/// 8-bit sRGB, as a display or a PNG has it.
struct Image8 {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgb;  // 3 * width * height, row 0 on top
};

}  // namespace nightcity
