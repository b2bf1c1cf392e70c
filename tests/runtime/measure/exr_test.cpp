#include "runtime/measure/exr.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "formats/error.h"
#include "runtime/measure/pictures.h"
#include "support/file_limit.h"
#include "support/temp_folder.h"

namespace nightcity::measure {
namespace {

class Exr : public testing::Test {
 protected:
  Image sample() const {
    Image image = test::grey(5, 3, 0.0f);
    for (std::size_t i = 0; i < image.rgb.size(); ++i)
      image.rgb[i] = 0.1f * static_cast<float>(i) + 1e-6f;
    image.layers.push_back({"albedo", {"R", "G", "B"}, std::vector<float>(45, 0.25f)});
    image.layers.push_back({"depth", {"Z"}, std::vector<float>(15)});
    for (std::size_t i = 0; i < 15; ++i)
      image.layers[1].values[i] = 1000.0f + static_cast<float>(i);
    image.info = {"pairwise",
                  64,
                  32,
                  5,
                  3,
                  "paths",
                  "windows,trees",
                  "wet=0.5 lights=lamp",
                  0xFFFFFFFFFFFFFFFFu,
                  3.25f,
                  "a device",
                  "City of X, CC BY 4.0",
                  "{\"fov_deg\":50}",
                  "20:00:00",
                  ""};
    return image;
  }
  test::TempFolder folder;
};

TEST_F(Exr, PictureLayersAndInfoComeBackBitForBit) {
  const Image out = sample();
  write_exr(folder / "a.exr", out);
  const Image in = read_exr(folder / "a.exr");
  EXPECT_EQ(in.width, 5u);
  EXPECT_EQ(in.height, 3u);
  EXPECT_EQ(in.rgb, out.rgb);
  ASSERT_EQ(in.layers.size(), 2u);
  ASSERT_NE(in.layer("depth"), nullptr);
  EXPECT_EQ(in.layer("depth")->values, out.layers[1].values);
  ASSERT_NE(in.layer("albedo"), nullptr);
  EXPECT_EQ(in.layer("albedo")->channels.size(), 3u);
  EXPECT_EQ(in.layer("normal"), nullptr);
  EXPECT_EQ(in.info.estimator, "pairwise");
  EXPECT_EQ(in.info.frames, 64u);
  EXPECT_EQ(in.info.candidates, 32u);
  EXPECT_EQ(in.info.neighbours, 5u);
  EXPECT_EQ(in.info.bounces, 3u);
  EXPECT_EQ(in.info.indirect, "paths");
  EXPECT_EQ(in.info.left_out, "windows,trees");
  EXPECT_EQ(in.info.settings, "wet=0.5 lights=lamp");
  EXPECT_EQ(in.info.licences, "City of X, CC BY 4.0");
  EXPECT_EQ(in.info.camera, "{\"fov_deg\":50}");
  EXPECT_EQ(in.info.time, "20:00:00");
  EXPECT_EQ(in.info.seed, 0xFFFFFFFFFFFFFFFFu);
  EXPECT_EQ(in.info.ev100, 3.25f);
  EXPECT_EQ(in.info.device, "a device");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST_F(Exr, LayerChannelsKeepTheirMeaningWhateverTheOrderInTheFile) {
  Image out = test::grey(2, 1, 1.0f);
  out.layers.push_back({"normal", {"Z", "X", "Y"}, {1, 2, 3, 4, 5, 6}});
  write_exr(folder / "a.exr", out);
  const Image in = read_exr(folder / "a.exr");
  const ImageLayer& layer = in.layers.at(0);  // OpenEXR sorts channels by name
  ASSERT_EQ(layer.channels, (std::vector<std::string>{"X", "Y", "Z"}));
  EXPECT_EQ(layer.values, (std::vector<float>{2, 3, 1, 5, 6, 4}));
}

TEST_F(Exr, NonFiniteValueIsNotWritten) {
  Image image = sample();
  image.rgb[3 * 7] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(write_exr(folder / "a.exr", image), Error);
  image = sample();
  image.layers[1].values[4] = std::numeric_limits<float>::quiet_NaN();
  try {
    write_exr(folder / "a.exr", image);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("depth"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("(4, 0)"), std::string::npos) << error.what();
  }
  EXPECT_EQ(folder.entries(), 0u);
}

TEST_F(Exr, ImpossibleLayersAreRefused) {
  for (const ImageLayer& layer :
       {ImageLayer{"", {"X"}, std::vector<float>(15)}, ImageLayer{"a", {}, {}},
        ImageLayer{"a", {"x.y"}, std::vector<float>(15)},
        ImageLayer{"depth", {"Z"}, std::vector<float>(15)},
        ImageLayer{"a", {"X"}, std::vector<float>(14)}}) {
    Image image = sample();
    image.layers.push_back(layer);
    EXPECT_THROW(write_exr(folder / "a.exr", image), Error);
  }
  EXPECT_THROW(write_exr(folder / "a.exr", Image()), Error);
  EXPECT_EQ(folder.entries(), 0u);
}

TEST_F(Exr, FolderThatIsNotThereIsAnError) {
  EXPECT_THROW(write_exr(folder / "no/a.exr", sample()), Error);
  EXPECT_THROW(read_exr(folder / "missing.exr"), Error);
  EXPECT_THROW(read_exr(folder.path()), Error);
}

TEST_F(Exr, AFullDiskIsAnErrorWhereverItEnds) {
  write_exr(folder / "whole.exr", sample());
  const std::size_t size = test::read_text(folder / "whole.exr").size();
  for (std::size_t limit = 0; limit < size; limit += 16) {
    const test::FileLimit disk(limit);
    EXPECT_THROW(write_exr(folder / "a.exr", sample()), Error) << limit << " of " << size;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "a.exr"));
}

TEST_F(Exr, FileCutAnywhereIsAnErrorNamingTheFile) {
  write_exr(folder / "a.exr", sample());
  const std::string whole = test::read_text(folder / "a.exr");
  for (std::size_t size = 0; size < whole.size(); size += 19) {
    test::write_text(folder / "cut.exr", whole.substr(0, size));
    try {
      read_exr(folder / "cut.exr");
      ADD_FAILURE() << "read " << size << " of " << whole.size() << " bytes";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("cut.exr"), std::string::npos) << error.what();
    }
  }
}

TEST_F(Exr, FlippedBytesNeverDoMoreThanFailOrGiveAPictureOfTheSameSize) {
  write_exr(folder / "a.exr", sample());
  const std::string whole = test::read_text(folder / "a.exr");
  for (std::size_t i = 0; i < whole.size(); i += 4) {
    std::string broken = whole;
    broken[i] = static_cast<char>(broken[i] ^ "\x01\x80\xFF"[i % 3]);
    test::write_text(folder / "b.exr", broken);
    try {
      const Image image = read_exr(folder / "b.exr");
      EXPECT_EQ(image.rgb.size(), 3 * image.pixels());
      for (const ImageLayer& layer : image.layers)
        EXPECT_EQ(layer.values.size(), layer.channels.size() * image.pixels());
    } catch (const Error&) {
    }
  }
}

TEST_F(Exr, OtherKindsOfFileAreErrors) {
  test::write_text(folder / "a.exr", std::string("glTF\2\0\0\0", 8) + std::string(5000, 'x'));
  EXPECT_THROW(read_exr(folder / "a.exr"), Error);
  test::write_text(folder / "a.exr", std::string("v/1\x01\x02\0\0\0", 8) + std::string(5000, 'x'));
  EXPECT_THROW(read_exr(folder / "a.exr"), Error);
}

// Puts numbers behind the size of an attribute, whose name and type are `key` with their ends.
void put_into_attribute(std::string& file, std::string_view key, std::vector<std::int32_t> numbers,
                        std::size_t skipped = 4) {
  const std::size_t at = file.find(key);
  ASSERT_NE(at, std::string::npos);
  std::memcpy(file.data() + at + key.size() + skipped, numbers.data(), 4 * numbers.size());
}

TEST_F(Exr, AHeaderDoesNotChooseHowMuchMemoryIsTaken) {
  using namespace std::string_view_literals;
  const auto corpus = std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/runtime/measure/corpus";
  const std::string lines = test::read_text(corpus / "layers.exr"),
                    tiles = test::read_text(corpus / "tiled.exr");
  constexpr auto window = "dataWindow\0box2i\0"sv, tile = "tiles\0tiledesc\0"sv;
  constexpr auto estimator = "nightcity.estimator\0string\0"sv;
  constexpr std::int32_t most = 2'147'483'647;
  std::vector<std::string> files(8);
  put_into_attribute(files[0] = lines, estimator, {1'900'000'000}, 0);
  put_into_attribute(files[1] = lines, window, {0, 0, 8, most - 1});
  put_into_attribute(files[2] = lines, window, {0, 0, 32'767, 32'767});
  put_into_attribute(files[3] = lines, window, {-most, -most, most, most});
  put_into_attribute(files[4] = tiles, tile, {60'000, 60'000});
  put_into_attribute(files[5] = tiles, window, {0, 0, 32'767, 32'767});
  put_into_attribute(files[6] = files[5], tile, {1, 1});
  // OpenEXR takes a list of channels to be as long as it is, and not as the file says.
  files[7] = test::read_text(corpus / "channels_too_long.exr");
  const auto peak_kb = [] {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  for (std::size_t i = 0; i < files.size(); ++i) {
    test::write_text(folder / "a.exr", files[i]);
    const long before_kb = peak_kb();
    try {
      read_exr(folder / "a.exr");
      ADD_FAILURE() << i;
    } catch (const Error& error) {
      const std::string message = error.what();
      EXPECT_TRUE(message.find("claims") != std::string::npos ||
                  message.find("a side must be") != std::string::npos)
          << i << ": " << message;
    }
    EXPECT_LT(peak_kb() - before_kb, 200'000) << i;
  }
}

}  // namespace
}  // namespace nightcity::measure
