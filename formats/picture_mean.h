// The mean colour of a picture file: what a surface reflects on average under its texture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace nightcity {

/// 8,192 by 8,192. A picture takes four bytes a pixel while it is read, and a file of sixty
/// kilobytes may hold a gigabyte of one colour.
constexpr std::int64_t max_picture_pixels = std::int64_t{1} << 26;

/// A PNG or JPEG, unpacked to four bytes a pixel.
class Picture {
 public:
  /// Returns nothing if the bytes are no such picture, or it has more than `max_pixels`.
  static std::optional<Picture> read(std::span<const std::byte> bytes,
                                     std::int64_t max_pixels = max_picture_pixels);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Returns the rows from above, four bytes a pixel: red, green and blue (sRGB), and alpha.
  std::span<const unsigned char> pixels() const {
    return {pixels_.get(), 4 * static_cast<std::size_t>(count_pixels())};
  }
  std::int64_t count_pixels() const { return std::int64_t{width_} * height_; }
  /// Returns the mean as find_picture_mean does.
  std::optional<glm::dvec3> find_mean(bool use_alpha) const;
  /// Returns the mean of the pixels between two texture coordinates (from the lower left, 1 being
  /// the picture's width and height, beyond which it repeats), each pixel alike, as linear Rec.
  /// 709. A part without width counts as a pixel's; coordinates that are no numbers stand for all
  /// of it. The mean of all is found once. Safe to call from several threads.
  glm::dvec3 find_mean_between(const glm::dvec2& low, const glm::dvec2& high) const;

 private:
  using Pixels = std::unique_ptr<unsigned char, void (*)(void*)>;
  Picture(Pixels pixels, int width, int height)
      : pixels_(std::move(pixels)), width_(width), height_(height) {}
  // Returns the mean of a box by its first pixel and size; beyond its sides the picture repeats.
  glm::dvec3 find_mean_of_box(std::int64_t x, std::int64_t y, std::int64_t columns,
                              std::int64_t rows) const;

  // A picture that repeats is asked for the mean of all of it by each surface.
  struct Whole {
    std::once_flag found;
    glm::dvec3 mean{0};
  };

  Pixels pixels_;
  int width_, height_;
  std::unique_ptr<Whole> whole_ = std::make_unique<Whole>();
};

/// Returns the mean of a PNG or JPEG, whose values are sRGB, as linear Rec. 709. Each pixel counts
/// by its alpha where `use_alpha`, and alike otherwise. Returns nothing if the bytes are no such
/// picture, it has more than `max_pixels`, or no pixel counts.
std::optional<glm::dvec3> find_picture_mean(std::span<const std::byte> bytes, bool use_alpha,
                                            std::int64_t max_pixels = max_picture_pixels);

/// Returns the pixels that a picture says it has; nothing where the bytes are no PNG or JPEG, or
/// one that Picture::read refuses for what its chunks or tables claim.
std::optional<std::int64_t> count_picture_pixels(std::span<const std::byte> bytes);

/// The limits of PictureBudget in words, for messages about a picture beyond it.
constexpr const char* picture_budget_text =
    "the textures of one file may have 268 million pixels and 64 more for each of their bytes; "
    "make them smaller";

/// Bounds what all pictures of a file may unpack to: four of the largest, and for each byte the 64
/// pixels that photographs and drawings keep below.
class PictureBudget {
 public:
  /// Returns whether a picture may be unpacked, and counts it then. A picture that comes again, at
  /// the same address, adds no bytes. One that has too many pixels alone costs nothing: it is not
  /// unpacked.
  bool take(std::span<const std::byte> picture);
  /// Returns whether `pixels` more may be unpacked, from a file of `bytes` that were not counted so
  /// far, and counts them then.
  bool take(std::int64_t pixels, std::size_t bytes);

 private:
  std::set<const std::byte*> seen_;
  std::int64_t left_ = 4 * max_picture_pixels;
};

}  // namespace nightcity
