// Every extract kept by the fuzzer gives an Error or data, never a crash.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "formats/error.h"
#include "tools/osm/read_osm.h"

namespace nightcity::osm {
namespace {

TEST(Corpus, EveryExtractIsReadOrRefused) {
  std::size_t files = 0, sound = 0;
  const auto corpus = std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/tools/osm/corpus";
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
    ++files;
    try {
      for (const OsmLampNode& lamp : read_osm(entry.path()).lamps) {
        EXPECT_LE(std::abs(lamp.lon_lat.x), 180) << entry.path();
        EXPECT_LE(std::abs(lamp.lon_lat.y), 90) << entry.path();
      }
      ++sound;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()), "") << entry.path();
    }
  }
  EXPECT_GE(files, 3u);
  EXPECT_GE(sound, 1u);
}

// libosmium reads on behind the end of such tags.
TEST(Corpus, ATagWithAZeroByteIsAnError) {
  const auto file = std::filesystem::path(NIGHTCITY_SOURCE_DIR) /
                    "tests/tools/osm/corpus/zero_byte_in_tag.osm.pbf";
  try {
    read_osm(file);
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("zero byte"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace nightcity::osm
