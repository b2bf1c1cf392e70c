#include "tools/layout/why_unlit.h"

#include <gtest/gtest.h>

#include <utility>

#include "tools/layout/street_plane.h"

namespace nightcity::layout {
namespace {

TEST(WhyUnlit, TagsDecideAndClassesDoWhereTheySayNothing) {
  const auto why = [](osm::OsmTags tags) {
    const auto lit = lights::read_lit_tags(tags, "lit").lit.kind;
    return why_unlit(test::street(1, {{0, 0}, {9, 0}}, std::move(tags)), lit);
  };
  EXPECT_EQ(why({{"highway", "residential"}}), "");
  EXPECT_EQ(why({{"highway", "residential"}, {"lit", "no"}}), "lit=no");
  EXPECT_EQ(why({{"highway", "footway"}, {"lit", "yes"}}), "");
  EXPECT_EQ(why({{"highway", "footway"}}), "unlit by class");
  EXPECT_EQ(why({{"highway", "footway"}, {"footway", "sidewalk"}, {"lit", "yes"}}),
            "crossing or pavement beside a street");
  EXPECT_EQ(why({{"highway", "motorway"}}), "unlit by class");
  EXPECT_EQ(why({{"highway", "motorway"}, {"lit", "24/7"}}), "");
  EXPECT_EQ(why({{"highway", "service"}, {"service", "driveway"}}), "unlit by class");
  EXPECT_EQ(why({{"highway", "primary"}, {"tunnel", "yes"}}), "tunnel or under cover");
  EXPECT_EQ(why({{"highway", "primary"}, {"layer", "-1"}}), "tunnel or under cover");
  EXPECT_EQ(why({{"highway", "primary"}, {"tunnel", "no"}}), "");
  EXPECT_EQ(why({{"highway", "residential"}, {"disused", "yes"}}), "disused");
  EXPECT_EQ(why({{"highway", "residential"}, {"abandoned", "2010"}, {"lit", "yes"}}), "disused");
  EXPECT_EQ(why({{"highway", "residential"}, {"disused", "no"}}), "");
  EXPECT_EQ(why({{"highway", "pedestrian"}, {"area", "yes"}}), "square mapped as an area");
  // A condition decides too: dark all night, or lit for a part of it.
  EXPECT_EQ(why({{"highway", "footway"}, {"lit:conditional", "yes @ (sunset-22:00)"}}), "");
  EXPECT_EQ(
      why({{"highway", "residential"}, {"lit", "no"}, {"lit:conditional", "yes @ (sunset-22:00)"}}),
      "");
  EXPECT_EQ(why({{"highway", "residential"}, {"lit", "Sa 17:00-22:00"}}), "lit=no");
}

}  // namespace
}  // namespace nightcity::layout
