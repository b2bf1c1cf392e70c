// Bounds that every part of the renderer keeps to.
#pragma once

#include <cstdint>

namespace nightcity::measure {

/// Greatest side of a picture that is read, rendered or written, in pixels: a hostile header must
/// not choose how much memory is allocated.
constexpr std::uint32_t max_image_side = 32768;

}  // namespace nightcity::measure
