#include "runtime/scene/bvh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "formats/error.h"

namespace nightcity {
namespace {

std::vector<Box> random_boxes(std::size_t count, float spread, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](float a, float b) { return a + (b - a) * float(random() >> 8) / 16777216.0f; };
  std::vector<Box> boxes(count);
  for (Box& box : boxes) {
    const glm::vec3 p(uniform(-spread, spread), uniform(0, 30), uniform(-spread, spread));
    box.grow(p);
    box.grow(p + glm::vec3(uniform(0, 5), uniform(0, 5), uniform(0, 5)));
  }
  return boxes;
}

// Every leaf's boxes lie inside the dequantised box its parent has for it, and each primitive is in one leaf.
void expect_sound(const Bvh& bvh, std::span<const Box> boxes, std::uint32_t max_leaf) {
  std::vector<int> seen(boxes.size());
  struct Visit {
    std::uint32_t node;
    Box bound;
    std::uint32_t stack;
  };
  Box everything;
  everything.grow(glm::vec3(-1e30f));
  everything.grow(glm::vec3(1e30f));
  std::vector<Visit> pending{{bvh.root, everything, 0}};
  std::uint32_t deepest = 0;
  while (!pending.empty()) {
    const Visit visit = pending.back();
    pending.pop_back();
    if (visit.node & BVH_LEAF) {
      const std::uint32_t first = visit.node & BVH_LEAF_FIRST_MASK;
      const std::uint32_t count = ((visit.node & ~BVH_LEAF) >> BVH_LEAF_COUNT_SHIFT) + 1;
      EXPECT_LE(count, max_leaf);
      for (std::uint32_t i = first; i < first + count; ++i) {
        const Box& box = boxes[bvh.order[i]];
        ++seen[bvh.order[i]];
        for (int axis = 0; axis < 3; ++axis) {
          // Not even on its sides: a ray that runs in a side, 0 * infinity to the slab test, misses nothing.
          EXPECT_LT(visit.bound.lower[axis], box.lower[axis]);
          EXPECT_GT(visit.bound.upper[axis], box.upper[axis]);
        }
      }
      continue;
    }
    const gpu::BvhNode& node = bvh.nodes[visit.node];
    std::uint32_t children = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      if (node.child[i] == BVH_EMPTY) continue;
      ++children;
      Box bound;
      for (int axis = 0; axis < 3; ++axis) {
        const float step = std::ldexp(1.0f, int((node.exponents >> (8 * axis)) & 255u) - 127);
        bound.lower[axis] = node.origin[axis] + float((node.lower[axis] >> (8 * i)) & 255u) * step;
        bound.upper[axis] = node.origin[axis] + float((node.upper[axis] >> (8 * i)) & 255u) * step;
      }
      pending.push_back({node.child[i], bound, visit.stack + 3});
    }
    EXPECT_GE(children, 1u);
    deepest = std::max(deepest, visit.stack + children - 1);
  }
  for (const int count : seen) EXPECT_EQ(count, 1);
  EXPECT_GE(deepest, bvh.stack_need);
}

TEST(Bvh, HoldsEveryBoxOnceAndInsideItsParents) {
  for (const std::size_t count : {1u, 2u, 4u, 5u, 17u, 3000u}) {
    const auto boxes = random_boxes(count, 500, unsigned(count));
    expect_sound(build_bvh(boxes, 4, 40), boxes, 4);
  }
}

TEST(Bvh, HoldsFarFromTheOriginWhereFloatsAreCoarse) {
  auto boxes = random_boxes(500, 50, 1);
  for (Box& box : boxes) {
    box.lower += glm::vec3(90000, 0, -90000);
    box.upper += glm::vec3(90000, 0, -90000);
  }
  expect_sound(build_bvh(boxes, 4, 40), boxes, 4);
}

TEST(Bvh, FlatAndIdenticalBoxesStillSplit) {
  std::vector<Box> boxes(1000);
  for (Box& box : boxes) box.grow(glm::vec3(1, 2, 3));
  expect_sound(build_bvh(boxes, 4, 40), boxes, 4);
}

TEST(Bvh, SizesAcrossManyMagnitudesStayWithinTheStack) {
  // Each box a tenth the size of the one before and inside it: the worst for a tree by area.
  std::vector<Box> boxes;
  for (int i = 0; i < 2000; ++i) {
    Box box;
    box.grow(glm::vec3(0));
    box.grow(glm::vec3(std::pow(10.0f, 4.0f - 8.0f * float(i) / 2000)));
    boxes.push_back(box);
  }
  const Bvh bvh = build_bvh(boxes, 1, 24);
  EXPECT_LE(bvh.stack_need, 24u);
  expect_sound(bvh, boxes, 1);
}

TEST(Bvh, RefusesWhatTheStackCannotHold) {
  EXPECT_THROW(build_bvh(random_boxes(5000, 100, 3), 1, 6), Error);
}

TEST(Bvh, EmptyInputGivesAnEmptyRoot) {
  EXPECT_EQ(build_bvh({}, 4, 40).root, BVH_EMPTY);
}

}  // namespace
}  // namespace nightcity
