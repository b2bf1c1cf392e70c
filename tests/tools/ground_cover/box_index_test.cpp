#include "tools/ground_cover/box_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tools/mesh/owner_finder.h"

namespace nightcity::ground_cover {
namespace {

TEST(BoxIndex, FindsEveryBoxThatMeetsARectangleAndEachOnce) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-5000, 5000), size(-2, 4);
  const auto make = [&] {
    const glm::dvec2 low(place(random), place(random));
    return Box{low, low + glm::dvec2(std::pow(10, size(random)), std::pow(10, size(random)))};
  };
  BoxIndex index;
  std::vector<Box> boxes;
  for (std::uint32_t i = 0; i < 500; ++i) {
    boxes.push_back(make());
    index.add(i, boxes.back());
  }
  for (int n = 0; n < 50; ++n) {
    const Box wanted = make();
    const auto found = index.find(wanted);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      const bool meets = boxes[i].low.x <= wanted.high.x && boxes[i].high.x >= wanted.low.x &&
                         boxes[i].low.y <= wanted.high.y && boxes[i].high.y >= wanted.low.y;
      EXPECT_TRUE(!meets || std::binary_search(found.begin(), found.end(), i));
    }
  }
}

TEST(BoxIndex, TheFirstThatHoldsAPlaceIsTheLeastOfAll) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-1000, 1000), size(0, 3.5);
  BoxIndex index;
  std::vector<Box> boxes;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const glm::dvec2 low(place(random), place(random));
    boxes.push_back(
        {low, low + glm::dvec2(std::pow(10, size(random)), std::pow(10, size(random)))});
    index.add(i, boxes.back());
  }
  int held = 0;
  for (int n = 0; n < 2000; ++n) {
    const glm::dvec2 p(place(random), place(random));
    const auto first =
        std::find_if(boxes.begin(), boxes.end(), [&](const Box& box) { return box.holds(p); });
    const std::uint32_t found =
        index.find_first(p, [&](std::uint32_t i) { return boxes[i].holds(p); });
    if (first == boxes.end())
      EXPECT_EQ(found, BoxIndex::none);
    else
      EXPECT_EQ(found, static_cast<std::uint32_t>(first - boxes.begin()));
    held += first != boxes.end();
  }
  EXPECT_GT(held, 500);
  EXPECT_LT(held, 1990);
}

// Strips of 200 m through a square of 256 m, in all directions.
std::vector<std::vector<Ring>> make_random_strips(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> place(-150, -100), turn(0, 6.3), half_width(0.05, 4);
  std::vector<std::vector<Ring>> strips;
  while (strips.size() < count) {
    const glm::dvec2 middle(place(random), place(random));
    const double angle = turn(random);
    const glm::dvec2 along = 100.0 * glm::dvec2(std::cos(angle), std::sin(angle)),
                     across = half_width(random) / 100 * glm::dvec2(-along.y, along.x);
    strips.push_back({{middle - along - across, middle + along - across, middle + along + across,
                       middle - along + across}});
  }
  return strips;
}

TEST(BoxIndex, ASplitSquareGivesTheSameFirstAndAsksFewer) {
  std::mt19937 random(5);
  const auto strips = make_random_strips(2000, random);
  BoxIndex whole, split;
  for (std::uint32_t i = 0; i < strips.size(); ++i) {
    whole.add(i, find_box(strips[i]));
    split.add(i, find_box(strips[i]));
  }
  split.split_crowded([&](std::uint32_t i, const Box& box) { return find_share(strips[i], box); },
                      [](std::uint32_t) { return std::size_t{4}; });
  std::uniform_real_distribution<double> place(-260, 20);
  std::size_t asked_whole = 0, asked_split = 0, held = 0;
  for (int n = 0; n < 5000; ++n) {
    const glm::dvec2 p(place(random), place(random));
    const auto find = [&](const BoxIndex& index, std::size_t& asked) {
      return index.find_first(p,
                              [&](std::uint32_t i) { return ++asked, mesh::holds(strips[i], p); });
    };
    const std::uint32_t first = find(whole, asked_whole);
    EXPECT_EQ(find(split, asked_split), first) << p.x << " " << p.y;
    held += first != BoxIndex::none;
  }
  EXPECT_GT(held, 2000u);
  EXPECT_LT(held, 4900u);
  EXPECT_LT(20 * asked_split, asked_whole);
}

// Expects the index to find the first area that holds a place, and returns its number. Counts in
// `asked` at how many areas the index looks.
std::uint32_t expect_first(const BoxIndex& index, const std::vector<std::vector<Ring>>& areas,
                           const glm::dvec2& p, std::size_t& asked) {
  std::uint32_t first = BoxIndex::none;
  for (std::uint32_t i = 0; i < areas.size() && first == BoxIndex::none; ++i)
    if (mesh::holds(areas[i], p)) first = i;
  EXPECT_EQ(index.find_first(p, [&](std::uint32_t i) { return ++asked, mesh::holds(areas[i], p); }),
            first);
  return first;
}

// Each goes to and fro through the square of 256 m, 20 lines of 200 m, 10 m apart.
TEST(BoxIndex, AreasThatWindThroughTheirSquareAreSplitAsTheirLinesWouldBe) {
  constexpr int turns = 20;
  std::vector<std::vector<Ring>> winding;
  for (int n = 0; n < 400; ++n) {
    const glm::dvec2 low(-240 + 0.5 * (n % 20), -240 + 0.5 * (n / 20));
    Ring there, back;
    for (int k = 0; k < turns; ++k)
      for (const int end : {k % 2, 1 - k % 2}) {
        there.push_back(low + glm::dvec2(200 * end, 10 * k));
        back.push_back(there.back() + glm::dvec2(0, 0.2));
      }
    there.insert(there.end(), back.rbegin(), back.rend());
    winding.push_back({there});
  }
  BoxIndex index;
  for (std::uint32_t i = 0; i < winding.size(); ++i) index.add(i, find_box(winding[i]));
  index.split_crowded([&](std::uint32_t i, const Box& box) { return find_share(winding[i], box); },
                      [&](std::uint32_t i) { return winding[i][0].size(); });
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-235, -45);
  std::size_t asked = 0;
  constexpr std::size_t places = 1000;
  for (std::size_t n = 0; n < places; ++n) {
    const glm::dvec2 p(place(random), place(random));
    expect_first(index, winding, p, asked);
  }
  EXPECT_LT(asked, 100 * places);  // of 400 areas
}

// Fewer areas than make a crowd of squares, but each look goes round 82 corners.
TEST(BoxIndex, AreasOfManyCornersAreACrowdSooner) {
  std::vector<std::vector<Ring>> winding;
  for (int n = 0; n < 40; ++n) {
    Ring ring;
    for (int k = 0; k <= 40; ++k) ring.push_back({-250 + 6 * k, -250 + 6 * n + 2 * (k % 2)});
    for (int k = 40; k >= 0; --k) ring.push_back(ring[static_cast<std::size_t>(k)] + 0.5);
    winding.push_back({ring});
  }
  BoxIndex index;
  for (std::uint32_t i = 0; i < winding.size(); ++i) index.add(i, {{-255, -255}, {-1, -1}});
  index.split_crowded([&](std::uint32_t i, const Box& box) { return find_share(winding[i], box); },
                      [&](std::uint32_t i) { return winding[i][0].size(); });
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-250, -10);
  std::size_t asked = 0, held = 0;
  for (int n = 0; n < 1000; ++n) {
    const glm::dvec2 p(place(random), place(random));
    held += expect_first(index, winding, p, asked) != BoxIndex::none;
  }
  EXPECT_GT(held, 20u);
  EXPECT_LT(asked, 5000u);  // of 40 areas at each of 1000 places
}

TEST(BoxIndex, AnAreaHasNoneAPartOrAllOfABox) {
  const std::vector<Ring> court{{{0, 0}, {10, 0}, {10, 10}, {0, 10}},
                                {{4, 4}, {6, 4}, {6, 6}, {4, 6}}};
  EXPECT_EQ(find_share(court, {{1, 1}, {3, 9}}), Share::all);
  EXPECT_EQ(find_share(court, {{4.5, 4.5}, {5.5, 5.5}}), Share::none);  // in the hole
  EXPECT_EQ(find_share(court, {{11, 1}, {12, 9}}), Share::none);
  EXPECT_EQ(find_share(court, {{3, 3}, {7, 7}}), Share::part);  // the hole is inside
  EXPECT_EQ(find_share(court, {{-1, -1}, {11, 11}}), Share::part);
  EXPECT_EQ(find_share(court, {{9, 1}, {11, 2}}), Share::part);
  const std::vector<Ring> aslant{{{0, 0}, {10, 10}, {9, 11}, {-1, 1}}};
  EXPECT_EQ(find_share(aslant, {{6, 0}, {10, 4}}), Share::none) << "in its box, beside it";
}

}  // namespace
}  // namespace nightcity::ground_cover
