#include "runtime/scene/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <random>

#include "formats/error.h"
#include "runtime/scene/bvh_node.h"
#include "runtime/scene/quantised_nodes.h"
#include "runtime/scene/triangle_pieces.h"
#include "tests/runtime/scene/node_boxes.h"

namespace nightcity::scene {
namespace {

// Every leaf's boxes lie inside the dequantised box that its parent holds for it, and each
// primitive is in exactly one leaf.
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
          // Not even on its sides: a ray in the plane of a side is 0 * infinity to the slab test,
          // and must miss nothing.
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
      pending.push_back({node.child[i], find_box(node, i), visit.stack + 3});
    }
    EXPECT_GE(children, 1u);
    deepest = std::max(deepest, visit.stack + children - 1);
  }
  for (const int count : seen) EXPECT_EQ(count, 1);
  EXPECT_GE(deepest, bvh.stack_need);
}

// The area of all inner nodes divided by that of the root: the number of them that a ray through
// the root enters on average.
double nodes_a_ray_enters(const Bvh& bvh) {
  double sum = 0, root = 0;
  for (std::size_t n = 0; n < bvh.nodes.size(); ++n) {
    const gpu::BvhNode& node = bvh.nodes[n];
    Box box;
    for (std::size_t i = 0; i < 4; ++i) {
      if (node.child[i] != BVH_EMPTY) box.grow(find_box(node, i));
    }
    sum += double(box.half_area());
    if (n == bvh.root) root = double(box.half_area());
  }
  return sum / root;
}

// Returns half the surfaces of the boxes that nodes have of their leaves, summed, m2.
double measure_leaves(const Bvh& bvh) {
  double sum = 0;
  for (const gpu::BvhNode& node : bvh.nodes)
    for (std::size_t i = 0; i < 4; ++i) {
      if (node.child[i] == BVH_EMPTY || !(node.child[i] & BVH_LEAF)) continue;
      glm::vec3 size;
      for (int axis = 0; axis < 3; ++axis)
        size[axis] = std::ldexp(float((node.upper[axis] >> (8 * i)) & 255u) -
                                    float((node.lower[axis] >> (8 * i)) & 255u),
                                int((node.exponents >> (8 * axis)) & 255u) - 127);
      sum += double(size.x) * size.y + double(size.y) * size.z + double(size.z) * size.x;
    }
  return sum;
}

// Returns the masks of everything below a child, by visiting it.
std::uint32_t mask_below(const Bvh& bvh, std::uint32_t child, std::span<const std::uint8_t> masks) {
  std::uint32_t mask = 0;
  if (child & BVH_LEAF) {
    const std::uint32_t first = child & BVH_LEAF_FIRST_MASK;
    const std::uint32_t count = ((child & ~BVH_LEAF) >> BVH_LEAF_COUNT_SHIFT) + 1;
    for (std::uint32_t i = first; i < first + count; ++i) mask |= masks[bvh.order[i]];
    return mask;
  }
  for (const std::uint32_t below : bvh.nodes[child].child)
    if (below != BVH_EMPTY) mask |= mask_below(bvh, below, masks);
  return mask;
}

TEST(Bvh, HoldsEveryBoxOnceAndInsideItsParents) {
  for (const std::size_t count : {1u, 2u, 4u, 5u, 17u, 3000u}) {
    const auto boxes = random_boxes(count, 500, unsigned(count));
    expect_sound(build_bvh(boxes, 4, 40), boxes, 4);
  }
}

// The traversal multiplies steps by floats: without a margin, rounding would let rays pass between
// a box and what it holds.
TEST(QuantiseNode, PlanesKeepTheirMarginWhereverFloatsRound) {
  std::mt19937 random(5);
  for (int round = 0; round < 2000; ++round) {
    const float place = std::ldexp(1.0f, int(random() % 40) - 20);
    auto boxes = random_boxes(4, 50, static_cast<unsigned>(random()));
    std::vector<hierarchy::MeasuredChild> children;
    Box all;
    for (Box& box : boxes) {
      box.lower += place;
      box.upper += place;
      all.grow(box);
      children.push_back({to_bounds(box), 0xFF});
    }
    const gpu::BvhNode node = quantise_node(to_bounds(all), children);
    for (std::size_t i = 0; i < children.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const double step = std::ldexp(1.0, int((node.exponents >> (8 * axis)) & 255u) - 127),
                     origin = double(node.origin[axis]);
        const unsigned lower = (node.lower[axis] >> (8 * i)) & 255u,
                       upper = (node.upper[axis] >> (8 * i)) & 255u;
        EXPECT_LT(origin + (lower + double(BVH_MARGIN) / 2) * step, double(boxes[i].lower[axis]));
        EXPECT_GT(origin + (upper - double(BVH_MARGIN) / 2) * step, double(boxes[i].upper[axis]));
      }
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
  // Each box a tenth the size of the one before and inside it: the worst case for splits by area.
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

// Houses of 60 parts each, some small and some large, with gaps between them, on
// ground of wide flat pieces.
std::vector<Box> boxes_of_a_city(int houses) {
  std::mt19937 random(4);
  const auto uniform = [&](float a, float b) {
    return a + (b - a) * float(random() >> 8) / 16777216.0f;
  };
  std::vector<Box> boxes;
  const auto add = [&](const glm::vec3& p, const glm::vec3& size) {
    boxes.emplace_back();
    boxes.back().grow(p);
    boxes.back().grow(p + size);
  };
  for (int i = 0; i < houses; ++i) {
    const float x = uniform(-1000, 1000), z = uniform(-1000, 1000), side = uniform(6, 20),
                height = uniform(4, 25);
    for (int part = 0; part < 60; ++part) {
      const float at = uniform(0, side), y = uniform(0, height),
                  size = part % 6 == 0 ? side : uniform(0.2f, 2);
      add({x + at, y, z}, {std::min(size, side - at), std::min(size, height - y), 0.1f});
    }
  }
  for (int i = 0; i < houses; ++i) {
    const float x = uniform(-1000, 1000), z = uniform(-1000, 1000), width = uniform(5, 200);
    add({x, 0, z}, {width, 0, 10});
  }
  return boxes;
}

// A few boxes that need a deep BVH once cost a whole city its surface-area heuristic.
TEST(Bvh, BoxesThatNeedADeepBvhDoNotSpoilTheRest) {
  auto boxes = boxes_of_a_city(400);
  for (int i = 0; i < 200; ++i) {
    Box box;
    box.grow(glm::vec3(0));
    box.grow(glm::vec3(std::pow(10.0f, 2.0f - 6.0f * float(i) / 200)));
    boxes.push_back(box);
  }
  const Bvh unbounded = build_bvh(boxes, 4, 4000), bvh = build_bvh(boxes, 4, 40);
  EXPECT_GT(unbounded.stack_need, 40u);
  EXPECT_LE(bvh.stack_need, 40u);
  expect_sound(bvh, boxes, 4);
  EXPECT_LT(nodes_a_ray_enters(bvh), 1.1 * nodes_a_ray_enters(unbounded));
}

TEST(Bvh, AnyStackThatSufficesForMediansSuffices) {
  for (const std::size_t count : {2u, 5u, 64u, 65u, 1000u, 4097u}) {
    const auto boxes = random_boxes(count, 300, unsigned(count));
    const std::uint32_t stack = needed_stack(count, 1);
    const Bvh bvh = build_bvh(boxes, 1, stack);
    EXPECT_LE(bvh.stack_need, stack);
    expect_sound(bvh, boxes, 1);
    EXPECT_THROW(build_bvh(boxes, 1, stack - 1), Error);
  }
}

TEST(Bvh, KeepsWhatCastsShadowsApartAndSaysWhatIsBelow) {
  const auto boxes = random_boxes(3000, 300, 9);
  std::vector<std::uint8_t> masks(boxes.size(), MASK_VISIBLE);
  for (std::size_t i = 0; i < masks.size(); i += 3) masks[i] |= MASK_SHADOW;
  const Bvh bvh = build_bvh(boxes, 1, 33, masks);
  expect_sound(bvh, boxes, 1);
  for (std::size_t n = 0; n < bvh.nodes.size(); ++n)
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t child = bvh.nodes[n].child[i],
                          mask = (bvh.nodes[n].masks >> (8 * i)) & 255u;
      ASSERT_EQ(mask, child == BVH_EMPTY ? 0u : mask_below(bvh, child, masks));
      // A child with the shadow bit: everything below it has the bit.
      if ((mask & MASK_SHADOW) == 0 || (child & BVH_LEAF) != 0) continue;
      for (std::size_t below = 0; below < 4; ++below) {
        if (bvh.nodes[child].child[below] != BVH_EMPTY) {
          EXPECT_NE((bvh.nodes[child].masks >> (8 * below)) & MASK_SHADOW, 0u);
        }
      }
    }
}

// Triangles of all sizes, some of them twice, in a field of 1 km.
// The triangles behind `before` others.
TriangleList list_of(const std::vector<gpu::Triangle>& triangles, std::size_t before = 0) {
  TriangleList list;
  for (std::size_t i = 0; i < before; ++i) list.push_back({});
  list.append(triangles);
  return list;
}

std::vector<gpu::Triangle> random_triangles(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](float a, float b) {
    return a + (b - a) * float(random() >> 8) / 16777216.0f;
  };
  std::vector<gpu::Triangle> triangles(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    gpu::Triangle& t = triangles[i];
    const glm::vec3 p(uniform(-500, 500), uniform(0, 30), uniform(-500, 500));
    const auto near = [&] { return p + glm::vec3(uniform(-2, 2), uniform(-2, 2), uniform(-2, 2)); };
    t = {near(), i % 7, near(), i, near(), NO_HIT};
    if (i % 10 == 9) {
      t = triangles[i - 1];
      t.feature = i;
    }
  }
  return triangles;
}

template <class Vector>
bool same_bytes(const Vector& a, const Vector& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

// Large enough for many tasks.
TEST(Bvh, TrianglesAndBoxesGiveTheSameBytesForAnyNumberOfThreads) {
  const auto triangles = random_triangles(300'000, 5);
  const auto boxes = random_boxes(200'000, 500, 6);
  std::vector<std::uint32_t> first_order;
  LargeVector<gpu::BvhNode> first_nodes;
  Bvh first_boxes;
  for (const unsigned threads : {1u, 2u, 3u, 8u}) {
    std::vector<std::uint32_t> order(triangles.size());
    LargeVector<gpu::BvhNode> nodes;
    append_bvh(nodes, list_of(triangles), 0, 4, 46, threads, order);
    Bvh bvh = build_bvh(boxes, 1, 46, {}, threads);
    if (threads == 1) {
      first_order = order;
      first_nodes = nodes;
      first_boxes = std::move(bvh);
      continue;
    }
    EXPECT_TRUE(same_bytes(order, first_order)) << threads;
    EXPECT_TRUE(same_bytes(nodes, first_nodes)) << threads;
    EXPECT_TRUE(same_bytes(bvh.nodes, first_boxes.nodes)) << threads;
    EXPECT_EQ(bvh.order, first_boxes.order) << threads;
  }
}

Box box_of(const gpu::Triangle& triangle) {
  Box box;
  for (const glm::vec3& corner : {triangle.v0, triangle.v1, triangle.v2}) box.grow(corner);
  return box;
}

TEST(Bvh, EveryTriangleIsInOneLeafInsideItsParents) {
  for (const std::size_t count : {1u, 3u, 5u, 1000u, 100'000u})
    for (const std::uint32_t max_leaf : {1u, 4u, 8u}) {
      const auto triangles = random_triangles(count, unsigned(count));
      Bvh bvh;
      bvh.order.resize(count);
      const BvhRoot root = append_bvh(bvh.nodes, list_of(triangles), 0, max_leaf, 46, 2, bvh.order);
      bvh.root = root.node;
      bvh.stack_need = root.stack_need;
      EXPECT_LE(root.stack_need, 46u);
      std::vector<Box> boxes;
      for (const gpu::Triangle& triangle : triangles) boxes.push_back(box_of(triangle));
      expect_sound(bvh, boxes, max_leaf);
    }
}

TEST(Bvh, CountsFromWhereItsTrianglesAndNodesLie) {
  const auto triangles = random_triangles(70'000, 8);
  LargeVector<gpu::BvhNode> nodes, later(1000);
  std::vector<std::uint32_t> order(triangles.size()), later_order(triangles.size());
  const BvhRoot at_start = append_bvh(nodes, list_of(triangles), 0, 4, 46, 2, order),
                moved = append_bvh(later, list_of(triangles, 500), 500, 4, 46, 2, later_order);
  EXPECT_EQ(moved.node, at_start.node + 1000);
  for (std::size_t i = 0; i < order.size(); ++i) ASSERT_EQ(later_order[i], order[i] + 500);
  ASSERT_EQ(later.size(), nodes.size() + 1000);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t child = nodes[n].child[i], there = later[n + 1000].child[i];
      ASSERT_EQ(there, child == BVH_EMPTY ? child : child + (child & BVH_LEAF ? 500 : 1000));
    }
}

// A field of quads, each of two triangles: pairs halve the work, and no leaf parts one.
TEST(Bvh, HalvesOfAQuadStayTogether) {
  std::vector<gpu::Triangle> triangles;
  for (int i = 0; i < 5000; ++i) {
    const glm::vec3 a(float(i % 70), 0, float(i / 70)), b = a + glm::vec3(0.9f, 0, 0),
                                                        c = a + glm::vec3(0.9f, 0.5f, 0.9f),
                                                        d = a + glm::vec3(0, 0.5f, 0.9f);
    triangles.push_back({a, 0, b, 0, c, 0});
    triangles.push_back({a, 0, c, 0, d, 0});
  }
  const auto count_pieces = [&](bool pairs) {
    hierarchy::Bounds box;
    return make_pieces(list_of(triangles), 0, triangles.size(), pairs, {}, 3, box).size();
  };
  EXPECT_EQ(count_pieces(true), 5000u);
  EXPECT_EQ(count_pieces(false), 10'000u);
  LargeVector<gpu::BvhNode> nodes;
  std::vector<std::uint32_t> order(triangles.size());
  append_bvh(nodes, list_of(triangles), 0, 4, 46, 2, order);
  for (std::size_t i = 0; i < order.size(); i += 2) {
    EXPECT_EQ(order[i] % 2, 0u);
    EXPECT_EQ(order[i + 1], order[i] + 1);
  }
}

// Walls that stand at an angle to the axes: in their own frame boxes hold less air.
TEST(Bvh, BoxesLieAlongAFrameAndHoldWhatIsTurnedIntoIt) {
  const float angle = 0.4f;
  const hierarchy::BoxFrame frame{{std::cos(angle), std::sin(angle)}, 0.01f};
  const glm::vec3 along(frame.along.x, 0, frame.along.y), across(-frame.along.y, 0, frame.along.x);
  std::vector<gpu::Triangle> walls;
  for (int i = 0; i < 4000; ++i) {
    const glm::vec3 a = float(i % 63) * 20.0f * along + float(i / 63) * 15.0f * across,
                    way = i % 2 == 0 ? 18.0f * along : 13.0f * across, up(0, 12, 0);
    walls.push_back({a, 0, a + way, 0, a + way + up, 0});
    walls.push_back({a, 0, a + way + up, 0, a + up, 0});
  }
  const auto build = [&](const hierarchy::BoxFrame& of, BvhRoot& root) {
    Bvh bvh;
    bvh.order.resize(walls.size());
    root = append_bvh(bvh.nodes, list_of(walls), 0, 2, 46, 2, bvh.order, of);
    bvh.root = root.node;
    bvh.stack_need = root.stack_need;
    return bvh;
  };
  BvhRoot root, root_along_axes;
  const Bvh bvh = build(frame, root), along_axes = build({}, root_along_axes);
  EXPECT_EQ(root.box.lower, root_along_axes.box.lower) << "in the frame of the triangles";
  EXPECT_EQ(root.box.upper, root_along_axes.box.upper);
  std::vector<Box> boxes;
  for (const gpu::Triangle& wall : walls) {
    Box& box = boxes.emplace_back();
    for (const glm::vec3& corner : {wall.v0, wall.v1, wall.v2})
      box.grow(glm::vec3(glm::dot(corner, along), corner.y, glm::dot(corner, across)));
    box.lower -= 0.009f;  // the margin, less than rounding may take
    box.upper += 0.009f;
  }
  expect_sound(bvh, boxes, 2);
  EXPECT_LT(measure_leaves(bvh), 0.7 * measure_leaves(along_axes));
}

// A shallow stack leaves medians only, and no room for pairs where half a leaf would be too deep.
TEST(Bvh, TrianglesInAShallowStack) {
  const auto triangles = random_triangles(4000, 2);
  const std::uint32_t least = needed_stack(triangles.size(), 4);
  for (const std::uint32_t stack : {least, least + 1, least + 3}) {
    Bvh bvh;
    bvh.order.resize(triangles.size());
    const BvhRoot root = append_bvh(bvh.nodes, list_of(triangles), 0, 4, stack, 1, bvh.order);
    EXPECT_LE(root.stack_need, stack);
    bvh.root = root.node;
    bvh.stack_need = root.stack_need;
    std::vector<Box> boxes;
    for (const gpu::Triangle& triangle : triangles) boxes.push_back(box_of(triangle));
    expect_sound(bvh, boxes, 4);
  }
}

TEST(Bvh, RefusesWhatTheStackCannotHold) {
  EXPECT_THROW(build_bvh(random_boxes(5000, 100, 3), 1, 6), Error);
}

TEST(Bvh, EmptyInputGivesAnEmptyRoot) {
  EXPECT_EQ(build_bvh({}, 4, 40).root, BVH_EMPTY);
}

}  // namespace
}  // namespace nightcity::scene
