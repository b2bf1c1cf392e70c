#include "tools/ground_cover/roadside.h"

#include <gtest/gtest.h>

#include "tests/tools/ground_cover/metre_map.h"
#include "tests/tools/ground_cover/plan_areas.h"
#include "tools/ground_cover/street_areas.h"

namespace nightcity::ground_cover {
namespace {

Cover lay_streets(const std::vector<osm::OsmWay>& ways) {
  Cover cover;
  add_streets(ways, true, as_metres, bounds, cover);
  cover.finish();
  return cover;
}

// OSM wiki: "Key:sidewalk", "Key:cycleway", "Key:tracktype".
TEST(Roadside, WidthsAndSurfacesOfWhatRunsBesideIt) {
  const auto widths = [](osm::OsmTags tags) {
    tags.emplace("highway", "residential");
    tags.emplace("sidewalk", "no");
    return areas_of(lay_streets({way({{-200, 0}, {200, 0}}, std::move(tags))}), middle);
  };
  const auto has = [&](osm::OsmTags tags, const char* material, double width_m) {
    auto areas = widths(std::move(tags));
    EXPECT_NEAR(areas[material] / 100, width_m, 1e-2);
  };
  has({{"sidewalk", "both"}, {"sidewalk:width", "1.5"}}, "paving stones", 3);
  has({{"sidewalk", "both"}, {"sidewalk:left:width", "4'"}, {"sidewalk:right:width", "1,5 m"}},
      "paving stones", 1.2192 + 1.5);
  has({{"sidewalk", "right;left"}}, "paving stones", 5);
  has({{"sidewalk", "both"}, {"sidewalk:surface", "gravel"}}, "gravel", 5);
  has({{"sidewalk", "both"}, {"sidewalk:left:surface", "gravel"}}, "gravel", 2.5);
  has({{"cycleway:both", "track"}, {"cycleway:both:width", "3"}}, "asphalt", 5.5 + 6);
  has({{"cycleway:right", "track"}, {"cycleway:right:width", "3"}}, "asphalt", 5.5 + 3);
  has({{"cycleway:both", "track"}, {"cycleway:surface", "paving_stones"}}, "paving stones", 4);
  has({{"oneway", "yes"}, {"width", "4"}, {"cycleway:left", "opposite_track"}}, "asphalt", 6);
  has({{"highway", "track"}, {"tracktype", "grade1"}}, "asphalt", 3);
  has({{"highway", "track"}, {"tracktype", "grade4"}}, "soil", 3);
  has({{"highway", "track"}, {"tracktype", "grade5"}}, "grass", 3);
  has({{"highway", "track"}, {"tracktype", "grade5"}, {"surface", "gravel"}}, "gravel", 3);
}

TEST(Roadside, RoadsOfNoKnownClassAreCountedInMetres) {
  const Cover cover = lay_streets({way({{-50, 0}, {50, 0}}, {{"highway", "raceway"}}),
                                   way({{-50, 9}, {50, 9}}, {{"highway", "construction"}})});
  EXPECT_NEAR(cover.left_out_m.at("highway=raceway"), 100, 1e-6);
  EXPECT_EQ(cover.left_out_m.size(), 1u);
}

}  // namespace
}  // namespace nightcity::ground_cover
