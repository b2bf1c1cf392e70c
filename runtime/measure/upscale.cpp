#include "runtime/measure/upscale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace nightcity::measure {
namespace {

constexpr std::array<std::string_view, 7> unmixed_layers{
    "normal", "depth", "motion", "position", "material", "feature", "light"};

// The two pixels along a side that a new one lies between, and the share of the second.
struct Between {
  std::size_t first, second;
  float share;
};

std::vector<Between> find_between(std::uint32_t from, std::uint32_t to) {
  std::vector<Between> places;
  for (std::uint32_t i = 0; i < to; ++i) {
    const double at = std::clamp((i + 0.5) * from / to - 0.5, 0.0, double(from - 1));
    const auto first = static_cast<std::size_t>(at);
    places.push_back({first, std::min<std::size_t>(first + 1, from - 1),
                      static_cast<float>(at - double(first))});
  }
  return places;
}

class Upscaler {
 public:
  Upscaler(const Image& image, std::uint32_t width, std::uint32_t height)
      : from_width_(image.width),
        columns_(find_between(image.width, width)),
        rows_(find_between(image.height, height)) {}

  std::vector<float> mix(const std::vector<float>& from, std::size_t channels) const {
    return fill(channels, [&](const Between& column, const Between& row, std::size_t channel) {
      const auto value = [&](std::size_t x, std::size_t y) {
        return from[(y * from_width_ + x) * channels + channel];
      };
      const auto along = [&](std::size_t y) {
        return value(column.first, y) * (1 - column.share) + value(column.second, y) * column.share;
      };
      return along(row.first) * (1 - row.share) + along(row.second) * row.share;
    });
  }

  std::vector<float> choose(const std::vector<float>& from, std::size_t channels) const {
    return fill(channels, [&](const Between& column, const Between& row, std::size_t channel) {
      const std::size_t x = column.share < 0.5f ? column.first : column.second,
                        y = row.share < 0.5f ? row.first : row.second;
      return from[(y * from_width_ + x) * channels + channel];
    });
  }

 private:
  template <class Find>
  std::vector<float> fill(std::size_t channels, const Find& find) const {
    std::vector<float> to;
    to.reserve(columns_.size() * rows_.size() * channels);
    for (const Between& row : rows_)
      for (const Between& column : columns_)
        for (std::size_t channel = 0; channel < channels; ++channel)
          to.push_back(find(column, row, channel));
    return to;
  }

  std::size_t from_width_;
  std::vector<Between> columns_, rows_;
};

}  // namespace

Image upscale(const Image& image, std::uint32_t width, std::uint32_t height) {
  if (image.width == width && image.height == height) return image;
  const Upscaler upscaler(image, width, height);
  Image large;
  large.width = width;
  large.height = height;
  large.info = image.info;
  large.rgb = upscaler.mix(image.rgb, 3);
  for (const ImageLayer& layer : image.layers) {
    const bool unmixed =
        std::find(unmixed_layers.begin(), unmixed_layers.end(), layer.name) != unmixed_layers.end();
    const std::size_t channels = layer.channels.size();
    large.layers.push_back(
        {layer.name, layer.channels,
         unmixed ? upscaler.choose(layer.values, channels) : upscaler.mix(layer.values, channels)});
  }
  return large;
}

}  // namespace nightcity::measure
