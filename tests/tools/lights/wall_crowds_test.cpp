#include "tools/lights/wall_crowds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <span>

#include "support/temp_folder.h"
#include "tools/lights/wall_index.h"

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

TEST(WallCrowds, GathersWhatABruteForceSearchGathers) {
  std::mt19937 random(11);
  std::vector<WallPlace> places;
  std::vector<std::uint32_t> owners;
  for (int n = 0; n < 1500; ++n) {
    places.push_back({static_cast<std::uint32_t>(random() % 9), 0, 0, 0, 0, 0, 0,
                      static_cast<std::uint32_t>(random() % 40)});
    owners.push_back(static_cast<std::uint32_t>(random() % 6));
  }
  const WallCrowds crowds = find_crowds(places, owners);
  std::vector<std::uint32_t> expected;
  for (std::uint32_t n = 0; n < places.size(); ++n) {
    std::set<std::uint32_t> before;  // owners of earlier walls there
    std::uint32_t first = n;
    for (std::uint32_t k = 0; k < n; ++k)
      if (places[k] == places[n]) first = std::min(first, k), before.insert(owners[k]);
    if (before.empty() || (before.size() == 1 && owners[n] != owners[first])) expected.push_back(n);
  }
  EXPECT_EQ(list_kept(crowds), expected);
  for (const WallCrowds::Kept& kept : crowds.kept) {
    std::set<std::uint32_t> there;
    for (std::uint32_t k = 0; k < places.size(); ++k)
      if (places[k] == places[kept.wall]) there.insert(owners[k]);
    ASSERT_EQ(kept.crowd != no_crowd, there.size() > 2);
    if (kept.crowd != no_crowd) {
      EXPECT_TRUE(std::ranges::equal(crowds.owners[kept.crowd], there));
    }
  }
}

// Sides of 10 m of houses on each other, each some micrometres beside the last.
TEST(WallIndex, ThousandsOfWallsThatAreAllButTheSameSayWhatTwoWouldSay) {
  const test::TempFolder folder;
  WallIndex few(folder / "few"), many(folder / "many");
  const auto add_house = [](WallIndex& index, double at, std::uint32_t owner) {
    const glm::dvec2 corners[] = {{at, at}, {at + 10, at}, {at + 10, at + 10}, {at, at + 10}};
    const glm::dvec2 normals[] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
    std::vector<WallIndex::UprightWall> walls;
    for (std::size_t k = 0; k < 4; ++k)
      walls.push_back({corners[k], corners[(k + 1) % 4], 0, 9, normals[k]});
    index.add(walls, owner);
  };
  constexpr std::uint32_t houses = 30'000;
  for (std::uint32_t n = 0; n < houses; ++n) {
    add_house(many, n * 3e-8, n);
    if (n < 3) add_house(few, n * 3e-8, n);
  }
  for (const std::uint32_t owner : {0u, 1u, 2u})
    for (const glm::dvec2& place : {glm::dvec2(5, -0.01), {5, 0.01}, {5, 3}, {5, -20}, {5, 9.9}})
      for (const double forward : {-1.0, 1.0}) {
        const glm::dvec3 p(place, 4), normal(0, forward, 0);
        EXPECT_EQ(many.blocked(std::span(&p, 1), normal, 0.5, owner),
                  few.blocked(std::span(&p, 1), normal, 0.5, owner))
            << owner << " " << place.y << " " << forward;
        EXPECT_EQ(many.inside_another(p, normal, owner), few.inside_another(p, normal, owner))
            << owner << " " << place.y << " " << forward;
      }
  // As many windows as there are houses, none of which is blocked by its like.
  for (std::uint32_t n = 0; n < houses; ++n) {
    const glm::dvec3 p(5, 0, 4);
    ASSERT_FALSE(many.blocked(std::span(&p, 1), {0, -1, 0}, 0.5, n));
  }
}

}  // namespace
}  // namespace nightcity::lights
