#include "formats/hierarchy/small_split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace nightcity::hierarchy {
namespace {

struct Weighted {
  Bounds box;
  std::uint32_t weight;
};

std::vector<Weighted> random_boxes(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return float(random() >> 8) / 16777216.0f; };
  std::vector<Weighted> boxes(count);
  for (Weighted& w : boxes) {
    const Float4 lower{10 * uniform(), 10 * uniform(), 10 * uniform(), 0};
    w.box = {lower, lower + Float4{uniform(), uniform(), 5 * uniform(), 0}};
    w.weight = 1 + random() % 2;
  }
  return boxes;
}

float cost_of(const std::vector<Weighted>& boxes, std::span<const std::uint8_t> part) {
  Bounds all;
  float weight = 0;
  for (const std::uint8_t i : part) {
    all.grow(boxes[i].box);
    weight += float(boxes[i].weight);
  }
  return weight * all.half_area();
}

float cost_of(const std::vector<Weighted>& boxes, std::span<const std::uint8_t> order,
              std::size_t middle) {
  return cost_of(boxes, order.first(middle)) + cost_of(boxes, order.subspan(middle));
}

TEST(SmallSplit, FindsTheCheapestOfAllPositionsOnAllAxes) {
  for (std::size_t count = 2; count <= max_small_split; ++count)
    for (unsigned seed = 0; seed < 20; ++seed) {
      const std::vector<Weighted> boxes = random_boxes(count, seed);
      SmallSplit split;
      for (const Weighted& w : boxes) split.add(w.box, w.weight);
      const std::uint32_t middle = split.find();
      ASSERT_GE(middle, 1u);
      ASSERT_LT(middle, count);
      std::vector<std::uint8_t> order(split.order().begin(), split.order().end()), all(count);
      for (std::size_t i = 0; i < count; ++i) all[i] = static_cast<std::uint8_t>(i);
      ASSERT_TRUE(std::is_permutation(order.begin(), order.end(), all.begin(), all.end()));
      const float found = cost_of(boxes, order, middle);
      for (int axis = 0; axis < 3; ++axis) {
        std::sort(all.begin(), all.end(), [&](std::uint8_t a, std::uint8_t b) {
          return boxes[a].box.centre()[axis] < boxes[b].box.centre()[axis];
        });
        for (std::size_t i = 1; i < count; ++i)
          ASSERT_LE(found, 1.00001f * cost_of(boxes, all, i)) << count << " boxes, seed " << seed;
      }
    }
}

TEST(SmallSplit, BoxesThatAreTheSameAreHalved) {
  SmallSplit split;
  for (int i = 0; i < 9; ++i) split.add({Float4{0, 0, 0, 0}, Float4{1, 1, 1, 0}}, 1);
  const std::uint32_t middle = split.find();
  EXPECT_TRUE(middle == 4 || middle == 5) << middle;
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(split.order()[i], i) << "their order is kept";
}

TEST(SmallSplit, BoxesWhoseAreaIsNoFloatAreSplit) {
  SmallSplit split;
  for (int i = 0; i < 4; ++i)
    split.add({Float4{-3e38f, -3e38f, -3e38f, 0}, Float4{3e38f, 3e38f, 3e38f, 0}}, 1);
  EXPECT_EQ(split.find(), 2u);
}

}  // namespace
}  // namespace nightcity::hierarchy
