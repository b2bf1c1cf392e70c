#include "runtime/scene/insert_leaves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <vector>

#include "runtime/scene/bvh.h"
#include "runtime/scene/quantised_nodes.h"
#include "tests/runtime/scene/node_boxes.h"

namespace nightcity::scene {
namespace {

constexpr std::uint32_t first_leaf = BVH_LEAF | BVH_INSTANCE;

bool holds(const Box& outer, const Box& inner) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(outer.lower[axis] < inner.lower[axis] && outer.upper[axis] > inner.upper[axis]))
      return false;
  return true;
}

// A visit of a whole hierarchy tells this.
struct Walk {
  std::map<std::uint32_t, int> leaves;  // how often each is met
  double area_m2 = 0;                   // half the surfaces of all children's boxes
  std::uint32_t need = 0;               // entries that a ray may have to defer
};

// `bounds`: the boxes of all nodes above. `box_of`: of a leaf.
template <class BoxOf>
std::uint32_t walk(const LargeVector<gpu::BvhNode>& nodes, std::uint32_t number,
                   std::vector<Box>& bounds, const BoxOf& box_of, Walk& result) {
  if (number & BVH_LEAF) {
    ++result.leaves[number];
    for (const Box& bound : bounds) EXPECT_TRUE(holds(bound, box_of(number)));
    return 0;
  }
  const gpu::BvhNode& node = nodes[number];
  std::uint32_t children = 0, deepest = 0;
  for (int i = 0; i < 4; ++i) {
    if (node.child[i] == BVH_EMPTY) continue;
    ++children;
    EXPECT_EQ((node.masks >> (8 * i)) & 255u, 255u);
    bounds.push_back(find_box(node, std::size_t(i)));
    result.area_m2 += double(bounds.back().half_area());
    deepest = std::max(deepest, walk(nodes, node.child[i], bounds, box_of, result));
    bounds.pop_back();
  }
  EXPECT_GE(children, 2u);
  return children - 1 + deepest;
}

struct Inserted {
  Bvh bvh;
  std::vector<Box> boxes, added;
  std::uint32_t put = 0, deferred = 0;

  Walk visit() const {
    std::vector<Box> bounds;
    Walk result;
    const auto box_of = [&](std::uint32_t leaf) {
      if (leaf & BVH_INSTANCE) return added[leaf & BVH_LEAF_FIRST_MASK];
      Box box;
      const std::uint32_t first = leaf & BVH_LEAF_FIRST_MASK;
      for (std::uint32_t i = 0; i <= (leaf & ~BVH_LEAF) >> BVH_LEAF_COUNT_SHIFT; ++i)
        box.grow(boxes[bvh.order[first + i]]);
      return box;
    };
    result.need = walk(bvh.nodes, bvh.root, bounds, box_of, result);
    return result;
  }
};

Inserted insert(std::size_t boxes, std::size_t added, std::uint32_t most_deferred, float size = 6) {
  Inserted result;
  result.boxes = random_boxes(boxes, 200, 1, 3);
  result.added = random_boxes(added, 200, 2, size);
  result.bvh = build_bvh(result.boxes, 4, 46);
  LeafInserter inserter(result.bvh.nodes, result.bvh.root, most_deferred);
  for (std::uint32_t i = 0; i < added; ++i)
    if (inserter.insert(first_leaf | i, to_bounds(result.added[i]))) ++result.put;
  result.deferred = inserter.deferred();
  inserter.finish();
  return result;
}

TEST(LeafInserter, PutsEachLeafOnceInsideAllBoxesAboveIt) {
  const Inserted all = insert(3000, 500, 16);
  EXPECT_EQ(all.put, 500u);
  const Walk walked = all.visit();
  std::size_t added = 0, before = 0;
  for (const auto& [leaf, times] : walked.leaves) {
    EXPECT_EQ(times, 1);
    if (leaf & BVH_INSTANCE)
      ++added;
    else
      before += ((leaf & ~BVH_LEAF) >> BVH_LEAF_COUNT_SHIFT) + 1;
  }
  EXPECT_EQ(added, 500u);
  EXPECT_EQ(before, 3000u);
}

TEST(LeafInserter, TellsHowMuchMoreRaysDeferAndKeepsToItsBound) {
  for (const std::uint32_t most : {0u, 1u, 2u, 3u, 5u, 16u}) {
    const Inserted all = insert(400, 2000, most);
    EXPECT_LE(all.deferred, most);
    EXPECT_LE(all.visit().need, all.bvh.stack_need + all.deferred) << most;
    std::size_t met = 0;
    for (const auto& [leaf, times] : all.visit().leaves) met += (leaf & BVH_INSTANCE) != 0;
    EXPECT_EQ(met, all.put) << "what was refused is not there";
  }
  EXPECT_EQ(insert(400, 2000, 0).put, 0u);
  EXPECT_EQ(insert(400, 2000, 16).put, 2000u);
}

// A hierarchy of its own over the leaves, under one root with the other, has a larger surface: rays
// then visit more boxes.
TEST(LeafInserter, LeavesLessToVisitThanTwoHierarchies) {
  const Inserted all = insert(3000, 500, 16);
  Inserted first = insert(3000, 0, 16), second;
  second.boxes = all.added;
  second.bvh = build_bvh(second.boxes, 1, 46);
  const double two_m2 = first.visit().area_m2 + second.visit().area_m2;
  EXPECT_LT(all.visit().area_m2, 0.9 * two_m2);
}

TEST(LeafInserter, ChangesNothingWithoutLeaves) {
  const Inserted none = insert(300, 0, 16);
  const Bvh made = build_bvh(none.boxes, 4, 46);
  ASSERT_EQ(none.bvh.nodes.size(), made.nodes.size());
  EXPECT_EQ(std::memcmp(none.bvh.nodes.data(), made.nodes.data(),
                        made.nodes.size() * sizeof made.nodes[0]),
            0);
  EXPECT_EQ(none.deferred, 0u);
}

// Boxes of all of them are alike, and a search must not look at each.
TEST(LeafInserter, TakesManyLeavesThatLieInOnePlace) {
  Inserted all;
  all.boxes = random_boxes(300, 200, 1, 3);
  Box whole;
  whole.grow(glm::vec3(-300, -10, -300));
  whole.grow(glm::vec3(300, 30, 300));
  all.added.assign(50'000, whole);
  all.bvh = build_bvh(all.boxes, 4, 46);
  LeafInserter inserter(all.bvh.nodes, all.bvh.root, 30);
  for (std::uint32_t i = 0; i < all.added.size(); ++i)
    if (inserter.insert(first_leaf | i, to_bounds(whole))) ++all.put;
  EXPECT_GT(all.put, 100u);
  EXPECT_LE(inserter.deferred(), 30u);
  inserter.finish();
  std::size_t met = 0;
  for (const auto& [leaf, times] : all.visit().leaves) met += (leaf & BVH_INSTANCE) != 0;
  EXPECT_EQ(met, all.put);
}

// Leaves that are wider than all else, or lie far away, make the root's boxes grow.
TEST(LeafInserter, TakesLeavesBeyondTheHierarchy) {
  const Inserted wide = insert(300, 5, 16, 2000);
  EXPECT_EQ(wide.put, 5u);
  EXPECT_EQ(wide.visit().leaves.size(), insert(300, 0, 16).visit().leaves.size() + 5);
}

}  // namespace
}  // namespace nightcity::scene
