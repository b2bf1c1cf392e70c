#include "tools/ground_cover/cover.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tools/roads/road_class.h"

namespace nightcity::ground_cover {
namespace {

CoverArea square(int rank, double low, double high, Surface surface) {
  return {rank, surface, {{{low, low}, {high, low}, {high, high}, {low, high}}}};
}

TEST(Cover, TheGreaterRankDecidesHowDeepAPlaceLies) {
  Cover cover;
  cover.add(square(1, 0, 100, {GroundKind::asphalt, true, true}));
  cover.add(square(2, 40, 60, {GroundKind::grass, false, false}));
  cover.finish();
  EXPECT_EQ(cover.depth_at({10, 10}), roads::kerb_m);
  EXPECT_EQ(cover.depth_at({50, 50}), 0);
  EXPECT_EQ(cover.depth_at({150, 50}), 0);
  EXPECT_EQ(cover.depth_at({std::nan(""), 50}), 0);
}

TEST(Cover, PartsComeInOrderOfRankAndCutToTheirBox) {
  Cover cover;
  cover.add(square(1, 0, 1e6, {GroundKind::grass, false, false}));
  cover.add(square(5, 990, 1010, {GroundKind::asphalt, true, true}));
  cover.add(square(9, 5000, 6000, {GroundKind::water, false, false}));
  cover.finish();
  const CoverPart part = cover.find_part({{1000, 1000}, {1100, 1100}}, {1000, 1000});
  ASSERT_EQ(part.areas.size(), 2u);
  EXPECT_EQ(cover.surfaces()[part.areas[0].label].kind, GroundKind::asphalt);
  for (const auto& area : part.areas)
    for (const glm::dvec2& p : area.rings.at(0)) {
      EXPECT_GE(p.x, 0);
      EXPECT_LE(p.x, 100);
    }
}

TEST(Cover, RailsComeBeforePaint) {
  Cover cover;
  cover.add_marking({{0, 0}, {9, 0}, {9, 9}});
  cover.add_marking({{0, 0}, {5, 0}, {5, 5}}, Marking::rail);
  EXPECT_FALSE(cover.empty());
  cover.finish();
  const CoverPart part = cover.find_part({{-10, -10}, {10, 10}}, {0, 0});
  ASSERT_EQ(part.markings.size(), 2u);
  EXPECT_EQ(part.markings[0].label, static_cast<std::uint32_t>(Marking::rail));
  EXPECT_EQ(part.markings[1].label, static_cast<std::uint32_t>(Marking::paint));
}

TEST(Cover, WhatIsNotFiniteIsCounted) {
  Cover cover;
  cover.add({1, {}, {{{0, 0}, {std::nan(""), 1}, {2, 2}}}});
  cover.add({1, {}, {{{0, 0}, {1e300, 1}, {2, 2}}}});
  cover.add({1, {}, {}});
  cover.add_marking({{0, 0}, {1, std::nan("")}, {1, 1}});
  cover.add(square(1, -9e7, 9e7, {}));  // wide, and finite
  cover.finish();
  EXPECT_EQ(cover.areas().size(), 1u);
  EXPECT_EQ(cover.left_out.at("area without a finite outline"), 3u);
}

}  // namespace
}  // namespace nightcity::ground_cover
