#include "tools/lights/wall_crowds.h"

#include <gtest/gtest.h>

namespace nightcity::lights {
namespace {

std::vector<std::uint32_t> list_kept(const WallCrowds& crowds) {
  std::vector<std::uint32_t> walls;
  for (const WallCrowds::Kept& kept : crowds.kept) walls.push_back(kept.wall);
  return walls;
}

TEST(WallCrowds, KeepsOfEachPlaceTheFirstWallOfTwoOwners) {
  const WallPlace a{1}, b{2}, c{0, 1};
  const std::vector<WallPlace> places{a, b, a, a, c, b, a, a};
  const std::vector<std::uint32_t> owners{5, 5, 5, 3, 3, 4, 9, 3};
  const WallCrowds crowds = find_crowds(places, owners);
  EXPECT_EQ(list_kept(crowds), (std::vector<std::uint32_t>{0, 1, 3, 4, 5}));
  ASSERT_EQ(crowds.owners.size(), 1u);  // of place a: b has two owners, and c one
  EXPECT_EQ(crowds.owners[0], (std::vector<std::uint32_t>{3, 5, 9}));
  EXPECT_EQ(crowds.kept[0].crowd, 0u);
  EXPECT_EQ(crowds.kept[1].crowd, no_crowd);
  EXPECT_EQ(crowds.kept[2].crowd, 0u);
  EXPECT_TRUE(crowds.holds(0, 9));
  EXPECT_FALSE(crowds.holds(0, 4));
}

TEST(WallCrowds, LeavesTwoWallsToLookAtHoweverManyStandInOnePlace) {
  std::vector<WallPlace> places(100'000, WallPlace{7});
  std::vector<std::uint32_t> owners;
  for (std::uint32_t i = 0; i < places.size(); ++i) owners.push_back(i);
  EXPECT_EQ(list_kept(find_crowds(places, owners)), (std::vector<std::uint32_t>{0, 1}));
}

}  // namespace
}  // namespace nightcity::lights
