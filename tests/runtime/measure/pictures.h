// Small pictures for tests.
#pragma once

#include <cstdint>

#include "runtime/measure/image.h"

namespace nightcity::test {

inline measure::Image grey(std::uint32_t width, std::uint32_t height, float cd_m2) {
  measure::Image image;
  image.width = width;
  image.height = height;
  image.rgb.assign(3 * image.pixels(), cd_m2);
  return image;
}

inline void set_pixel(measure::Image& image, std::uint32_t x, std::uint32_t y, float cd_m2) {
  for (std::size_t i = 0; i < 3; ++i) image.rgb[3 * (std::size_t{y} * image.width + x) + i] = cd_m2;
}

}  // namespace nightcity::test
