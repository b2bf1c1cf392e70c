#include "tools/ground_cover/box_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

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

}  // namespace
}  // namespace nightcity::ground_cover
