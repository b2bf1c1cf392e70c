// libFuzzer target: any bytes as a texture, which stb_image decodes. A mean that is found is a
// colour, and what is decoded has a number of pixels before.
#include <cstdint>
#include <cstdlib>
#include <span>

#include "formats/picture_mean.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity;
  // A header of a few bytes may ask for seconds of work on a cut picture.
  constexpr std::int64_t max_pixels = 1 << 16;
  const auto bytes = std::as_bytes(std::span(data, size));
  const auto pixels = count_picture_pixels(bytes);
  if (pixels && *pixels < 0) std::abort();
  if (Picture::read(bytes, max_pixels) && !pixels) std::abort();
  for (const bool use_alpha : {false, true}) {
    const auto mean = find_picture_mean(bytes, use_alpha, max_pixels);
    if (!mean) continue;
    for (int c = 0; c < 3; ++c)
      if (!((*mean)[c] >= 0 && (*mean)[c] <= 1 + 1e-9)) std::abort();
  }
  return 0;
}
