// Every extract kept by the fuzzer gives an Error or data, never a crash.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "formats/error.h"
#include "tools/osm/map_areas.h"
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

TEST(Corpus, EveryMapGivesAreasOrIsRefused) {
  std::size_t areas = 0;
  const auto corpus = std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/tools/osm/corpus";
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
    try {
      const AreaSelection all{{"building", "building:part", "natural", "landuse"}};
      for (const MapArea& area : read_map_areas(entry.path(), all, 500).areas) {
        EXPECT_FALSE(area.tags.empty()) << entry.path();
        for (const MapRings& rings : area.rings) EXPECT_GE(rings.outer.size(), 3u) << entry.path();
        ++areas;
      }
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()), "") << entry.path();
    }
  }
  EXPECT_GE(areas, 10u);
}

// The same lake, in three packings: one outline of two ways, and an island.
TEST(Corpus, ALakeOfTwoWaysIsTheSameInEveryPacking) {
  for (const char* name :
       {"lake_of_two_ways.osm", "lake_of_two_ways.osm.gz", "lake_of_two_ways.osm.pbf"}) {
    const MapAreas map = read_map_areas(
        std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/tools/osm/corpus" / name,
        {{"natural"}}, 500);
    ASSERT_EQ(map.areas.size(), 1u) << name;
    EXPECT_EQ(map.areas[0].id, "relation/1") << name;
    ASSERT_EQ(map.areas[0].rings.size(), 1u) << name;
    EXPECT_EQ(map.areas[0].rings[0].outer.size(), 4u) << name;
    ASSERT_EQ(map.areas[0].rings[0].holes.size(), 1u) << name;
    EXPECT_EQ(map.areas[0].rings[0].holes[0].size(), 4u) << name;
  }
}

// libosmium doubles ids, and the area of the largest had the number of that of -1, whose place it
// took.
TEST(Corpus, AnIdThatHasNoAreaIsAnError) {
  for (const char* name : {"largest_id.osm", "largest_id.osm.gz"}) {
    const auto file = std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/tools/osm/corpus" / name;
    try {
      const MapAreas map = read_map_areas(file, {{"natural"}}, 500);
      ADD_FAILURE() << name << " was read: " << map.areas.size() << " areas";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("id: "), std::string::npos) << error.what();
    }
  }
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
