// PNG files of known pixels.
#pragma once

#include <zlib.h>

#include <array>
#include <cstddef>
#include <functional>
#include <string>

namespace nightcity::test {

inline std::string png_number(std::size_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xFF);
  return bytes;
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto sum =
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return png_number(data.size()) + body + png_number(sum);
}

/// `rows`: each with its filter byte before it. `form`: bit depth, colour type, 0, 0, 0.
inline std::string make_png(std::size_t width, std::size_t height, const std::string& form,
                            const std::string& rows) {
  uLongf size = compressBound(rows.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(rows.data()), rows.size());
  packed.resize(size);
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", png_number(width) + png_number(height) + form) +
         png_chunk("IDAT", packed) + png_chunk("IEND", "");
}

/// A white picture of one bit a pixel: its rows deflate to a thousandth.
inline std::string make_white_png(std::size_t width, std::size_t height) {
  std::string rows;
  for (std::size_t y = 0; y < height; ++y) rows += '\0' + std::string((width + 7) / 8, '\xff');
  return make_png(width, height, std::string("\1\0\0\0\0", 5), rows);
}

/// A picture of the sRGB bytes that `colour(x, y)` returns, y from the top.
inline std::string make_rgb_png(
    std::size_t width, std::size_t height,
    const std::function<std::array<unsigned char, 3>(std::size_t, std::size_t)>& colour) {
  std::string rows;
  for (std::size_t y = 0; y < height; ++y) {
    rows += '\0';
    for (std::size_t x = 0; x < width; ++x)
      for (const unsigned char channel : colour(x, y)) rows += static_cast<char>(channel);
  }
  return make_png(width, height, std::string("\10\2\0\0\0", 5), rows);
}

}  // namespace nightcity::test
