#include "runtime/measure/png.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "formats/error.h"
#include "support/temp_folder.h"

namespace nightcity::measure {
namespace {

class Png : public testing::Test {
 protected:
  void SetUp() override {
    image = {17, 9, std::vector<std::uint8_t>(3 * 17 * 9)};
    for (std::size_t i = 0; i < image.rgb.size(); ++i)
      image.rgb[i] = static_cast<std::uint8_t>(i * 37);
  }

  test::TempFolder folder;
  Image8 image;
};

TEST_F(Png, PictureComesBackByteForByte) {
  write_png(folder / "a.png", image);
  const Image8 in = read_png(folder / "a.png");
  EXPECT_EQ(in.width, image.width);
  EXPECT_EQ(in.height, image.height);
  EXPECT_EQ(in.rgb, image.rgb);
}

TEST_F(Png, SaysWhichEstimatorMadeIt) {
  ImageInfo info;
  info.estimator = "paper";
  info.frames = 16;
  info.ev100 = 2.5f;
  info.settings = "wet=0.5";
  write_png(folder / "a.png", image, png_text(info));
  const std::string bytes = test::read_text(folder / "a.png");
  EXPECT_NE(bytes.find(std::string("tEXtEstimator\0paper", 19)), std::string::npos);
  EXPECT_NE(bytes.find(std::string("tEXtFrames\0"
                                   "16",
                                   13)),
            std::string::npos);
  EXPECT_NE(bytes.find(std::string("tEXtSettings\0wet=0.5", 20)), std::string::npos);
  EXPECT_NE(bytes.find("sRGB"), std::string::npos);
  EXPECT_EQ(read_png(folder / "a.png").rgb, image.rgb);
}

TEST_F(Png, CutOrBrokenFileIsAnError) {
  write_png(folder / "a.png", image);
  const std::string whole = test::read_text(folder / "a.png");
  // The last 12 bytes are the end mark, which libpng does not miss once the last row is there.
  for (std::size_t size = 0; size + 20 < whole.size(); size += 13) {
    test::write_text(folder / "cut.png", whole.substr(0, size));
    EXPECT_THROW(read_png(folder / "cut.png"), Error) << size << " of " << whole.size();
  }
  for (std::size_t i = 0; i < whole.size(); i += 3) {
    std::string broken = whole;
    broken[i] = static_cast<char>(broken[i] ^ '\x55');
    test::write_text(folder / "b.png", broken);
    try {
      EXPECT_EQ(read_png(folder / "b.png").rgb.size(), image.rgb.size());
    } catch (const Error&) {
    }
  }
}

TEST_F(Png, HugeSizeInAShortFileIsRefused) {
  write_png(folder / "a.png", image);
  std::string bytes = test::read_text(folder / "a.png");
  bytes[18] = '\x7f';  // width 32513: within the limit of a side, not within what the file can hold
  bytes[22] = '\x7f';
  test::write_text(folder / "b.png", bytes);
  EXPECT_THROW(read_png(folder / "b.png"), Error);
}

TEST_F(Png, WhatCannotBeWrittenLeavesNothing) {
  EXPECT_THROW(write_png(folder / "no/a.png", image), Error);
  EXPECT_THROW(write_png(folder / "a.png", Image8{4, 4, {1, 2, 3}}), Error);
  EXPECT_THROW(write_png(folder / "a.png", Image8{}), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace nightcity::measure
