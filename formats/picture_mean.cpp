#include "formats/picture_mean.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
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

// Returns whether every Huffman table of a JPEG (ITU-T T.81, B.2.4.2) has at most 256 codes. Of more
// stb_image 2.27, Debian's, writes the lengths behind the end of their array. Wherever stb_image
// finds a table, the marker FF C4 stands before it.
bool has_sound_huffman_tables(std::span<const std::byte> bytes) {
  const auto at = [&](std::size_t i) {
    return i < bytes.size() ? std::to_integer<std::size_t>(bytes[i]) : 0;
  };
  for (std::size_t marker = 0; marker + 1 < bytes.size(); ++marker) {
    if (at(marker) != 0xFF || at(marker + 1) != 0xC4) continue;
    const std::size_t end = marker + 2 + (at(marker + 2) << 8 | at(marker + 3));
    for (std::size_t table = marker + 4; table < end;) {
      const std::size_t kind = at(table) >> 4, number = at(table) & 15;
      if (kind > 1 || number > 3) break;  // it refuses these itself
      std::size_t codes = 0;
      for (std::size_t i = 1; i <= 16; ++i) codes += at(table + i);
      if (codes > 256) return false;
      table += 17 + codes;
    }
  }
  return true;
}

bool is_png(std::span<const std::byte> bytes) {
  return bytes.size() > 4 && std::memcmp(bytes.data(), "\x89PNG", 4) == 0;
}

}  // namespace

std::optional<glm::dvec3> find_picture_mean(std::span<const std::byte> bytes, bool use_alpha,
                                            std::int64_t max_pixels) {
  static const auto linear = [] {
    std::array<double, 256> table;
    for (std::size_t i = 0; i < table.size(); ++i)
      table[i] = linear_from_srgb(static_cast<std::uint8_t>(i));
    return table;
  }();
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) return std::nullopt;
  if (!is_png(bytes) && !has_sound_huffman_tables(bytes)) return std::nullopt;
  const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(data, size, &width, &height, &channels) ||
      std::int64_t{width} * height > max_pixels)
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
