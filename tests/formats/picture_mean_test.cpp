#include "formats/picture_mean.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <span>
#include <string>

namespace nightcity {
namespace {

std::string big_endian(std::size_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xFF);
  return bytes;
}

std::string chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto sum =
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return big_endian(data.size()) + body + big_endian(sum);
}

// A white picture of one bit a pixel: its rows deflate to a thousandth.
std::string make_white_png(std::size_t width, std::size_t height) {
  std::string rows;
  for (std::size_t y = 0; y < height; ++y) rows += '\0' + std::string((width + 7) / 8, '\xff');
  uLongf size = compressBound(rows.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(rows.data()), rows.size());
  packed.resize(size);
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR", big_endian(width) + big_endian(height) + std::string("\1\0\0\0\0", 5)) +
         chunk("IDAT", packed) + chunk("IEND", "");
}

TEST(PictureMean, OfWhiteIsOne) {
  const std::string png = make_white_png(20, 10);
  const auto mean = find_picture_mean(std::as_bytes(std::span(png)), false);
  ASSERT_TRUE(mean.has_value());
  for (int c = 0; c < 3; ++c) EXPECT_NEAR((*mean)[c], 1, 1e-12);
}

TEST(PictureMean, APictureThatWouldFillTheMemoryIsNotUnpacked) {
  // 66 kB that are a gigabyte in memory.
  const std::string png = make_white_png(16384, 16384);
  EXPECT_LT(png.size(), 70'000u);
  EXPECT_FALSE(find_picture_mean(std::as_bytes(std::span(png)), false).has_value());
}

}  // namespace
}  // namespace nightcity
