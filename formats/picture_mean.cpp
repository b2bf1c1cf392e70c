#include "formats/picture_mean.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

// Only the two formats of glTF 2.0 (section 3.9.1); the other decoders would only be a risk.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace nightcity {
namespace {

// IEC 61966-2-1.
double linear_from_srgb(std::uint8_t value) {
  const double v = value / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

}  // namespace

std::optional<glm::dvec3> find_picture_mean(std::span<const std::byte> bytes, bool use_alpha) {
  static const auto linear = [] {
    std::array<double, 256> table;
    for (std::size_t i = 0; i < table.size(); ++i)
      table[i] = linear_from_srgb(static_cast<std::uint8_t>(i));
    return table;
  }();
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) return std::nullopt;
  const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(data, size, &width, &height, &channels) ||
      std::int64_t{width} * height > max_picture_pixels)
    return std::nullopt;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(data, size, &width, &height, &channels, 4), stbi_image_free);
  if (!pixels) return std::nullopt;
  glm::dvec3 sum(0);
  double weights = 0;
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (std::size_t i = 0; i < count; ++i) {
    const stbi_uc* pixel = pixels.get() + 4 * i;
    const double weight = use_alpha ? pixel[3] / 255.0 : 1.0;
    sum += weight * glm::dvec3(linear[pixel[0]], linear[pixel[1]], linear[pixel[2]]);
    weights += weight;
  }
  if (!(weights > 0)) return std::nullopt;
  return sum / weights;
}

}  // namespace nightcity
