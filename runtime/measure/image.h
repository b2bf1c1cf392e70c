// A rendered picture in memory: luminance per channel, other values of each pixel, and how it was
// made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nightcity::measure {

/// Other values of each pixel: "albedo" with channels R, G and B, "depth" with Z. Whole numbers are
/// exact up to 2^24.
struct ImageLayer {
  std::string name;                   // without a dot and not empty
  std::vector<std::string> channels;  // without the layer's name: "R", "G", "B" or "X", "Y" or "Z"
  std::vector<float> values;  // width * height * channels.size(), pixel by pixel, row 0 on top
};

/// The way a picture was made. It stays with the picture, so that a biased or
/// filtered one is recognised.
struct ImageInfo {
  std::string estimator;         // "" = not known (another program made it)
  std::uint32_t frames = 0;      // frames accumulated; 0 = not known
  std::uint32_t candidates = 0;  // per pixel and frame; 0 = not known or none
  std::uint32_t neighbours = 0;  // reused per pixel and frame
  std::uint32_t bounces = 0;     // of light before the surface that is seen; 0 = direct light alone
  std::string indirect;          // how the light that bounced was found; "" where there is none
  std::string left_out;          // parts of the scene that were not loaded (--leave-out); "" = none
  std::string settings;          // those that differ from the defaults, "name=value ..."; "" = none
  std::uint64_t seed = 0;
  std::optional<float> ev100;  // exposure a viewer should start with
  std::string device;          // the Vulkan device's own name
  std::string licences;        // whose data the picture shows, to be shown with it; "" = not known
  std::string camera;          // as scene::to_text gives it; "" = not known
  std::string time;            // of the night, HH:MM:SS; "" = not known
  std::string eye;             // what an eye or a camera adds in a PNG; "" = nothing
};

/// Linear Rec. 709 RGB in cd/m2.
struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<float> rgb;  // 3 * width * height, row 0 on top
  std::vector<ImageLayer> layers;
  ImageInfo info;

  std::size_t pixels() const { return std::size_t{width} * height; }
  /// Returns the layer of that name, or nullptr.
  const ImageLayer* layer(const std::string& name) const {
    for (const ImageLayer& candidate : layers)
      if (candidate.name == name) return &candidate;
    return nullptr;
  }
};

/// 8-bit sRGB, as displays and PNGs use it.
struct Image8 {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgb;  // 3 * width * height, row 0 on top
};

}  // namespace nightcity::measure
