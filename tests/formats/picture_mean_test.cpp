#include "formats/picture_mean.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/mapped_file.h"
#include "support/make_png.h"

namespace nightcity {
namespace {

using test::make_rgb_png;
using test::make_white_png;

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

// Memory would be taken for what the chunk claims.
TEST(PictureMean, ADataChunkThatIsLongerThanTheFileIsRefused) {
  std::string png = make_white_png(20, 10);
  png[png.find("IDAT") - 4] = 0x5D;
  EXPECT_FALSE(Picture::read(std::as_bytes(std::span(png))).has_value());
}

TEST(PictureMean, APartIsCountedFromTheLowerLeftAndRepeats) {
  // Red above green, with a blue column on the right.
  const std::string png = make_rgb_png(4, 4, [](std::size_t x, std::size_t y) {
    if (x == 3) return std::array<unsigned char, 3>{0, 0, 255};
    return y < 2 ? std::array<unsigned char, 3>{255, 0, 0}
                 : std::array<unsigned char, 3>{0, 255, 0};
  });
  const auto picture = Picture::read(std::as_bytes(std::span(png)));
  ASSERT_TRUE(picture.has_value());
  EXPECT_EQ(picture->count_pixels(), 16);
  const auto expect = [&](const glm::dvec2& low, const glm::dvec2& high, const glm::dvec3& colour) {
    const glm::dvec3 mean = picture->find_mean_between(low, high);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], colour[c], 1e-12) << low.x << " " << low.y;
  };
  expect({0, 0}, {0.5, 0.5}, {0, 1, 0});
  expect({0, 0.5}, {0.5, 1}, {1, 0, 0});
  expect({0.75, 0}, {1, 1}, {0, 0, 1});
  expect({0.5, 0.25}, {1, 0.75}, {0.25, 0.25, 0.5});
  expect({2, -3}, {2.5, -2.5}, {0, 1, 0});
  expect({0.9, 0}, {1.1, 0.1}, {0, 0.5, 0.5});
  expect({0.1, 0.1}, {0.1, 0.1}, {0, 1, 0});
  const glm::dvec3 whole = *picture->find_mean(false);
  const double infinity = std::numeric_limits<double>::infinity();
  expect({0, 0}, {1, 1}, whole);
  expect({-5, -5}, {5, 5}, whole);
  expect({infinity, infinity}, {-infinity, -infinity}, whole);
  expect({1e300, 0}, {1e300, 0.2}, {0, 0.75, 0.25});
}

// Four large pictures of one colour are unpacked and no more, and other pictures still are.
TEST(PictureBudget, HasRoomForFourLargePicturesAndForThoseThatHaveBytes) {
  const std::string large = make_white_png(8192, 8192), small = make_white_png(20, 10);
  const std::string too_large = make_white_png(16384, 16384);
  PictureBudget budget;
  const auto take = [&](const std::string& png) {
    return budget.take(std::as_bytes(std::span(png)));
  };
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(take(large)) << i;
    EXPECT_TRUE(take(too_large)) << "find_picture_mean refuses it";
  }
  EXPECT_FALSE(take(large));
  EXPECT_TRUE(take(small));
  EXPECT_TRUE(take("no picture"));
}

// stb_image 2.27 reads a table that the file does not hold from memory as it finds it.
TEST(PictureMean, AJpegWithoutItsHuffmanTableDoesNotDependOnWhatTheMemoryHeldBefore) {
  const MappedFile jpeg(std::filesystem::path(NIGHTCITY_SOURCE_DIR) /
                        "tests/formats/corpus/picture/no_huffman_table.jpg");
  std::optional<glm::dvec3> first;
  for (const char filling : {'\0', '\x55', '\xff'}) {
    std::vector<std::unique_ptr<std::string>> freed;  // as large as the decoder's state
    for (int i = 0; i < 8; ++i) freed.push_back(std::make_unique<std::string>(18'500, filling));
    freed.clear();
    const auto mean = find_picture_mean(jpeg.bytes(), false);
    if (filling == '\0') first = mean;
    EXPECT_EQ(mean.has_value(), first.has_value());
    if (mean && first) {
      EXPECT_EQ(*mean, *first);
    }
  }
}

// stb_image 2.27 writes the lengths of more than 256 codes behind their array, and it does so where
// it is asked for the size alone.
TEST(PictureMean, AJpegWithATooLongHuffmanTableHasNoSizeEither) {
  const MappedFile jpeg(std::filesystem::path(NIGHTCITY_SOURCE_DIR) /
                        "tests/formats/corpus/picture/huffman_table_too_long.jpg");
  EXPECT_FALSE(count_picture_pixels(jpeg.bytes()));
  EXPECT_FALSE(Picture::read(jpeg.bytes()));
}

}  // namespace
}  // namespace nightcity
