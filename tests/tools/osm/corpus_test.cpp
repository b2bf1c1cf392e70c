// Every extract kept by the fuzzer gives an Error or data, never a crash.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iterator>
#include <string>

#include "formats/error.h"
#include "support/corpus.h"
#include "support/temp_folder.h"
#include "tools/osm/first_nodes.h"
#include "tools/osm/map_areas.h"
#include "tools/osm/read_osm.h"

namespace nightcity::osm {
namespace {

const auto corpus = std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/tools/osm/corpus";

TEST(Corpus, EveryExtractIsReadOrRefused) {
  const auto files = test::read_each_file(corpus, 3, [](const std::filesystem::path& file) {
    for (const OsmLampNode& lamp : read_osm(file).lamps) {
      EXPECT_LE(std::abs(lamp.lon_lat.x), 180) << file;
      EXPECT_LE(std::abs(lamp.lon_lat.y), 90) << file;
    }
  });
  EXPECT_GE(files.sound, 1u);
}

TEST(Corpus, EveryMapGivesAreasOrIsRefused) {
  std::size_t areas = 0;
  test::read_each_file(corpus, 3, [&](const std::filesystem::path& file) {
    const AreaSelection all{{"building", "building:part", "natural", "landuse"}};
    for (const MapArea& area : read_map_areas(file, all, 500).areas) {
      EXPECT_FALSE(area.tags.empty()) << file;
      for (const MapRings& rings : area.rings) EXPECT_GE(rings.outer.size(), 3u) << file;
      ++areas;
    }
  });
  EXPECT_GE(areas, 10u);
}

// The same lake, in three packings: one outline of two ways, and an island.
TEST(Corpus, ALakeOfTwoWaysIsTheSameInEveryPacking) {
  for (const char* name :
       {"lake_of_two_ways.osm", "lake_of_two_ways.osm.gz", "lake_of_two_ways.osm.pbf"}) {
    const MapAreas map = read_map_areas(corpus / name, {{"natural"}}, 500);
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
    const auto file = corpus / name;
    try {
      const MapAreas map = read_map_areas(file, {{"natural"}}, 500);
      ADD_FAILURE() << name << " was read: " << map.areas.size() << " areas";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("id: "), std::string::npos) << error.what();
    }
  }
}

// libosmium leaves the way out of the list of an area's ways, and read behind the end of that.
TEST(Corpus, AMultipolygonOfTheWayZeroIsBroken) {
  const MapAreas map = read_map_areas(corpus / "way_zero.osm", {{"natural"}}, 500);
  EXPECT_TRUE(map.areas.empty());
  EXPECT_EQ(map.broken, 1u);
}

// libosmium reads on behind the end of such tags.
TEST(Corpus, ATagWithAZeroByteIsAnError) {
  const auto file = corpus / "zero_byte_in_tag.osm.pbf";
  try {
    read_osm(file);
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("zero byte"), std::string::npos) << error.what();
  }
}

std::ptrdiff_t count_descriptors() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/fd"),
                       std::filesystem::directory_iterator());
}

// libosmium's own parser leaves the file of a PBF open that an exception ends: in its header, in
// its blobs, or between them.
TEST(Corpus, ABrokenPbfIsClosedHoweverOftenItIsRead) {
  const std::string whole = test::read_text(corpus / "lake_of_two_ways.osm.pbf");
  const test::TempFolder folder;
  std::size_t errors = 0;
  const auto count_error = [&](const auto& read) {
    try {
      read();
    } catch (const Error&) {
      ++errors;
    }
  };
  const auto read_all = [&] {
    for (const std::size_t bytes : {std::size_t{20}, whole.size() / 2, whole.size() - 1}) {
      const auto file = folder / "cut.osm.pbf";
      test::write_text(file, whole.substr(0, bytes));
      count_error([&] { read_osm(file); });
      count_error([&] { read_map_areas(file, {{"natural"}}, 500); });
      count_error([&] { read_first_nodes(file, 1000); });
    }
  };
  read_all();  // opens what stays open for the whole program
  const auto before = count_descriptors();
  errors = 0;
  for (int i = 0; i < 50; ++i) read_all();
  EXPECT_EQ(errors, 50u * 9);
  EXPECT_EQ(count_descriptors(), before);
}

}  // namespace
}  // namespace nightcity::osm
