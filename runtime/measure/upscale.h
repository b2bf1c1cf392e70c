// Pictures of one size made from those of another.
#pragma once

#include "runtime/measure/image.h"

namespace nightcity::measure {

/// Returns the picture with other sides, each at least as long as its own. Light, in cd/m2, and
/// layers of light and reflectance are bilinear between the centres of the picture's pixels; layers
/// of places, directions and numbers are those of the nearest pixel. The mean luminance stays
/// within what the picture's border has more or less than the rest.
Image upscale(const Image& image, std::uint32_t width, std::uint32_t height);

}  // namespace nightcity::measure
