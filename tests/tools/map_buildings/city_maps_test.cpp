// Maps keep their buildings for one city, and as long as it lives.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>

#include "support/temp_folder.h"
#include "tools/map_buildings/file_buildings.h"

namespace nightcity::map_buildings {
namespace {

using test::TempFolder;
using test::write_text;

// A map of one house of four corners.
std::string write_house(const std::string& kind) {
  return "<osm><node id='1' lat='0' lon='10'/><node id='2' lat='0' lon='10.0001'/>"
         "<node id='3' lat='0.0001' lon='10.0001'/><node id='4' lat='0.0001' lon='10'/>"
         "<way id='1'><nd ref='1'/><nd ref='2'/><nd ref='3'/><nd ref='4'/><nd ref='1'/>"
         "<tag k='building' v='" +
         kind + "'/></way></osm>";
}

TEST(CityMaps, EachMapIsReadOnce) {
  const TempFolder folder;
  write_text(folder / "a.osm", write_house("school"));
  write_text(folder / "b.osm", write_house("church"));
  CityMaps maps({folder / "a.osm", folder / "b.osm"});
  const CityMaps::Areas first = maps.read(100), again = maps.read(100);
  ASSERT_EQ(first.size(), 2u);
  EXPECT_EQ(first[0]->areas.at(0).tags.at("building"), "school");
  EXPECT_EQ(first[1]->areas.at(0).tags.at("building"), "church");
  EXPECT_EQ(again, first) << "the same areas, not others that are alike";
}

TEST(CityMaps, AnotherLimitIsAnotherAnswer) {
  const TempFolder folder;
  write_text(folder / "a.osm", write_house("school"));
  CityMaps maps({folder / "a.osm"});
  EXPECT_EQ(maps.read(100).at(0)->too_long, 0u);
  EXPECT_EQ(maps.read(3).at(0)->too_long, 1u);
  EXPECT_EQ(maps.read(100).at(0)->too_long, 0u);
}

TEST(CityMaps, CitiesOfTheSameFilesShareNothing) {
  const TempFolder folder;
  const std::filesystem::path file = folder / "a.osm";
  write_text(file, write_house("school"));
  CityMaps one({file}), other({file});
  EXPECT_EQ(one.read(100).at(0)->areas.at(0).tags.at("building"), "school");
  // As long as before, and at the same time.
  const auto time = std::filesystem::last_write_time(file);
  write_text(file, write_house("church"));
  std::filesystem::last_write_time(file, time);
  EXPECT_EQ(other.read(100).at(0)->areas.at(0).tags.at("building"), "church");
  EXPECT_EQ(one.read(100).at(0)->areas.at(0).tags.at("building"), "school");
}

TEST(CityMaps, TheOnlyMapIsGivenAwayOnceAndReadAnewThen) {
  const TempFolder folder;
  write_text(folder / "a.osm", write_house("school"));
  CityMaps maps({folder / "a.osm"});
  const auto find_kind = [](const osm::MapAreas& areas) {
    return areas.areas.at(0).tags.at("building");
  };
  const auto looked_at = maps.read(100).at(0);
  write_text(folder / "a.osm", write_house("church"));
  EXPECT_EQ(find_kind(maps.take_only(100)), "school") << "as it was read before";
  EXPECT_EQ(find_kind(*looked_at), "school") << "who looks at it keeps it";
  EXPECT_EQ(find_kind(maps.take_only(100)), "church");
  maps.read(100);
  EXPECT_EQ(maps.take_only(3).too_long, 1u);
}

TEST(CityMaps, WhatTheyKeepGoesWithThem) {
  const TempFolder folder;
  write_text(folder / "a.osm", write_house("school"));
  std::weak_ptr<const osm::MapAreas> kept;
  {
    CityMaps maps({folder / "a.osm"});
    kept = maps.read(100).at(0);
    EXPECT_FALSE(kept.expired());
  }
  EXPECT_TRUE(kept.expired());
}

}  // namespace
}  // namespace nightcity::map_buildings
