#include "formats/picture_mean.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>

#include "formats/srgb.h"

// Only the two formats of glTF 2.0 (section 3.9.1); the other decoders would only be a risk.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
// Memory of zeros, because a scan may name a Huffman table that the file does not hold: stb_image
// 2.27, Debian's, then reads the table that happens to be in memory, and with it other memory.
#define STBI_MALLOC(bytes) std::calloc(1, bytes)
#define STBI_REALLOC(memory, bytes) std::realloc(memory, bytes)
#define STBI_FREE(memory) std::free(memory)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace nightcity {
namespace {

// Returns whether every Huffman table of a JPEG (ITU-T T.81, B.2.4.2) has at most 256 codes. Of
// more stb_image 2.27, Debian's, writes the lengths behind the end of their array. Wherever
// stb_image finds a table, the marker FF C4 stands before it.
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

// Returns whether stb_image 2.27 can be given the data chunks of a PNG. It copies those of an empty
// first one to a null pointer, and takes memory for whatever length a chunk claims, up to 2 GB. No
// writer begins with an empty one, and of a file that is cut nothing is shown in any case.
bool has_sound_data(std::span<const std::byte> png) {
  constexpr std::size_t signature = 8, before = 8, around = 12;  // bytes: length, type, checksum
  bool is_first = true;
  for (std::size_t at = signature; at + before <= png.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i)
      length = length << 8 | std::to_integer<std::size_t>(png[at + i]);
    if (std::memcmp(&png[at + 4], "IDAT", 4) == 0) {
      if (length > png.size() - at - before || (is_first && length == 0)) return false;
      is_first = false;
    }
    at += around + length;
  }
  return true;  // it refuses a PNG without data itself
}

struct PictureSize {
  int width, height;
};

// Returns the size that a picture's header says; nothing where the bytes are no PNG or JPEG, or one
// that stb_image cannot be given: reading the header alone, it reads Huffman tables as well.
std::optional<PictureSize> find_size(std::span<const std::byte> bytes) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) return std::nullopt;
  if (is_png(bytes) ? !has_sound_data(bytes) : !has_sound_huffman_tables(bytes))
    return std::nullopt;
  PictureSize size{0, 0};
  int channels = 0;
  if (!stbi_info_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()),
                             static_cast<int>(bytes.size()), &size.width, &size.height, &channels))
    return std::nullopt;
  return size;
}

glm::dvec3 to_linear(const stbi_uc* pixel) {
  return {linear_from_srgb8(pixel[0]), linear_from_srgb8(pixel[1]), linear_from_srgb8(pixel[2])};
}

// The pixels along one side that lie between two texture coordinates: the first, and their number.
struct PixelRange {
  std::int64_t first, count;
};
PixelRange find_range(double low, double high, int size) {
  constexpr double farthest = 1e6;  // repetitions of a picture: beyond it a double holds no pixel
  if (!(std::abs(low) <= farthest) || !(std::abs(high) <= farthest) || !(high - low < 1))
    return {0, size};
  const auto first = static_cast<std::int64_t>(std::floor(low * size));
  const auto last = static_cast<std::int64_t>(std::ceil(high * size)) - 1;
  return {first, std::clamp<std::int64_t>(last - first + 1, 1, size)};
}

}  // namespace

std::optional<Picture> Picture::read(std::span<const std::byte> bytes, std::int64_t max_pixels) {
  const std::optional<PictureSize> said = find_size(bytes);
  if (!said || std::int64_t{said->width} * said->height > max_pixels) return std::nullopt;
  const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  Pixels pixels(stbi_load_from_memory(data, size, &width, &height, &channels, 4), stbi_image_free);
  if (!pixels || width < 1 || height < 1) return std::nullopt;
  return Picture(std::move(pixels), width, height);
}

std::optional<glm::dvec3> Picture::find_mean(bool use_alpha) const {
  glm::dvec3 sum(0);
  double weights = 0;
  const auto count = static_cast<std::size_t>(count_pixels());
  for (std::size_t i = 0; i < count; ++i) {
    const stbi_uc* pixel = pixels_.get() + 4 * i;
    const double weight = use_alpha ? pixel[3] / 255.0 : 1.0;
    sum += weight * to_linear(pixel);
    weights += weight;
  }
  if (!(weights > 0)) return std::nullopt;
  return sum / weights;
}

glm::dvec3 Picture::find_mean_between(const glm::dvec2& low, const glm::dvec2& high) const {
  const PixelRange x = find_range(low.x, high.x, width_);
  const PixelRange y = find_range(1 - high.y, 1 - low.y, height_);  // rows run down
  if (x.count < width_ || y.count < height_)
    return find_mean_of_box(x.first, y.first, x.count, y.count);
  std::call_once(whole_->found, [&] { whole_->mean = find_mean_of_box(0, 0, x.count, y.count); });
  return whole_->mean;
}

glm::dvec3 Picture::find_mean_of_box(std::int64_t x, std::int64_t y, std::int64_t columns,
                                     std::int64_t rows) const {
  glm::dvec3 sum(0);
  const auto wrap = [](std::int64_t i, int size) { return (i % size + size) % size; };
  for (std::int64_t j = y; j < y + rows; ++j)
    for (std::int64_t i = x; i < x + columns; ++i)
      sum += to_linear(pixels_.get() + 4 * (wrap(j, height_) * width_ + wrap(i, width_)));
  return sum / static_cast<double>(columns * rows);
}

std::optional<glm::dvec3> find_picture_mean(std::span<const std::byte> bytes, bool use_alpha,
                                            std::int64_t max_pixels) {
  const std::optional<Picture> picture = Picture::read(bytes, max_pixels);
  return picture ? picture->find_mean(use_alpha) : std::nullopt;
}

std::optional<std::int64_t> count_picture_pixels(std::span<const std::byte> bytes) {
  const std::optional<PictureSize> size = find_size(bytes);
  return size ? std::optional(std::int64_t{size->width} * size->height) : std::nullopt;
}

bool PictureBudget::take(std::span<const std::byte> picture) {
  const std::size_t bytes = seen_.insert(picture.data()).second ? picture.size() : 0;
  const std::int64_t pixels = count_picture_pixels(picture).value_or(0);
  return take(pixels > max_picture_pixels ? 0 : pixels, bytes);
}

bool PictureBudget::take(std::int64_t pixels, std::size_t bytes) {
  constexpr std::int64_t pixels_a_byte = 64;
  left_ += pixels_a_byte * static_cast<std::int64_t>(bytes);
  if (pixels > left_) return false;
  left_ -= pixels;
  return true;
}

}  // namespace nightcity
