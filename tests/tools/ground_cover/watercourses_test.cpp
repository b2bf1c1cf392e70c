#include "tools/ground_cover/watercourses.h"

#include <gtest/gtest.h>

#include "tests/tools/ground_cover/metre_map.h"
#include "tests/tools/ground_cover/plan_areas.h"
#include "tools/ground_cover/street_areas.h"

namespace nightcity::ground_cover {
namespace {

Cover lay_water(osm::OsmTags tags) {
  const std::vector<osm::OsmWay> lines{way({{-50, 0}, {50, 0}}, std::move(tags))};
  Cover cover;
  add_watercourses(lines, as_metres, bounds, cover);
  return cover;
}

// OSM wiki, "Key:waterway": a line is the middle of the water, and `width` says how wide it is.
TEST(Watercourses, ALineIsWaterOfTheWidthThatItSays) {
  for (const auto& [key, width] :
       {std::pair{"width", "4"}, {"width", "4 m"}, {"est_width", "4,0"}}) {
    Cover cover = lay_water({{"waterway", "stream"}, {key, width}});
    cover.finish();
    EXPECT_NEAR(areas_of(cover, middle).at("water") / 100, 4, 0.2) << key << "=" << width;
    EXPECT_TRUE(cover.left_out_m.empty());
  }
}

TEST(Watercourses, WhatIsNotDrawnIsCountedInMetres) {
  const auto reason_of = [](osm::OsmTags tags) {
    const Cover cover = lay_water(std::move(tags));
    EXPECT_TRUE(cover.areas().empty());
    EXPECT_EQ(cover.left_out_m.size(), 1u);
    EXPECT_NEAR(cover.left_out_m.begin()->second, 100, 1e-6);
    return cover.left_out_m.begin()->first;
  };
  EXPECT_EQ(reason_of({{"waterway", "brook"}}), "watercourse without a width");
  EXPECT_EQ(reason_of({{"waterway", "stream"}, {"width", "2"}, {"tunnel", "culvert"}}),
            "watercourse below the ground");
  EXPECT_EQ(reason_of({{"waterway", "canal"}, {"width", "9"}, {"bridge", "aqueduct"}}),
            "watercourse on a bridge");
  EXPECT_EQ(reason_of({{"waterway", "stream"}, {"width", "2"}, {"intermittent", "yes"}}),
            "watercourse that is dry at times");
  EXPECT_TRUE(lay_water({{"natural", "coastline"}}).left_out_m.empty()) << "which is the sea's";
}

// The widths of OSM2World.
TEST(Watercourses, WithoutAWidthALineIsAsWideAsItsKindUsuallyIs) {
  for (const auto& [kind, width] : {std::pair{"river", 3.0},
                                    {"canal", 2.0},
                                    {"drain", 1.0},
                                    {"ditch", 1.0},
                                    {"stream", 0.5},
                                    {"tidal_channel", 3.0}})
    for (const char* said : {"", "wide"}) {
      osm::OsmTags tags{{"waterway", kind}};
      if (*said) tags["width"] = said;
      Cover cover = lay_water(std::move(tags));
      EXPECT_EQ(cover.assumed.at("width of a watercourse"), 1u) << kind;
      cover.finish();
      EXPECT_NEAR(areas_of(cover, middle).at("water") / 100, width, 0.01 * width) << kind;
    }
  EXPECT_TRUE(lay_water({{"waterway", "stream"}, {"width", "2"}}).assumed.empty());
}

TEST(Watercourses, StreetsAreSeenWhereTheyCross) {
  const std::vector<osm::OsmWay> stream{way({{-50, 0}, {50, 0}}, {{"width", "4"}})},
      street{way({{0, -50}, {0, 50}}, {{"highway", "residential"}, {"sidewalk", "no"}})};
  Cover cover;
  add_watercourses(stream, as_metres, bounds, cover);
  add_streets(street, true, as_metres, bounds, cover);
  cover.finish();
  EXPECT_EQ(cover.surface_at({0, 0})->kind, GroundKind::asphalt);
  EXPECT_EQ(cover.surface_at({20, 0})->kind, GroundKind::water);
}

}  // namespace
}  // namespace nightcity::ground_cover
