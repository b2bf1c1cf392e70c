// Stored hierarchies over triangles that were cut into pieces.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "tests/runtime/scene/stored_build.h"

namespace nightcity::scene {
namespace {

// Long triangles at any angle, and small ones between them.
TriangleList long_triangles(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](float a, float b) {
    return a + (b - a) * float(random() >> 8) / 16777216.0f;
  };
  TriangleList list;
  for (std::size_t i = 0; i < count; ++i) {
    const float angle = uniform(0, 3), half = i % 4 == 0 ? uniform(20, 150) : uniform(0.1f, 2);
    const glm::vec3 middle(uniform(-400, 400), uniform(0, 10), uniform(-400, 400)),
        way(half * std::cos(angle), uniform(-1, 1), half * std::sin(angle));
    list.push_back({middle - way, 0, middle + way, 0, middle + glm::vec3(1, 0, 2), 0});
  }
  return list;
}

Built build_cut(const TriangleList& triangles, const hierarchy::BoxFrame& frame = {}) {
  std::vector<hierarchy::Corners> corners(triangles.size());
  triangles.copy_corners(0, corners);
  hierarchy::CutPieces pieces;
  std::vector<hierarchy::TrianglePiece> made;
  hierarchy::append_pieces(corners, true, 0, frame, made, &pieces.large);
  pieces.pieces.assign(made.begin(), made.end());
  Built built;
  StoredHierarchy& stored = built.stored;
  stored.triangles = static_cast<std::uint32_t>(triangles.size());
  stored.along = frame.along;
  hierarchy::Bounds box;
  for (const hierarchy::Corners& c : corners) box.grow(c.bounds());
  stored.lower = to_box(box).lower;
  stored.upper = to_box(box).upper;
  built.encoded = hierarchy::build_encoded(std::move(pieces), stored.triangles, 2, stored.area_m2);
  stored.topology = std::as_bytes(std::span(built.encoded.topology));
  stored.order = std::as_bytes(std::span(built.encoded.order));
  stored.cuts = std::as_bytes(std::span(built.encoded.cuts));
  return built;
}

Loaded load_cut(const TriangleList& triangles, const StoredHierarchy& stored,
                const hierarchy::BoxFrame& frame = {}) {
  Loaded loaded;
  loaded.order.resize(triangles.size() + stored.count_cuts());
  loaded.fault = append_stored_bvh(loaded.nodes, triangles, 0, stored, hierarchy::static_leaf,
                                   hierarchy::static_stack, 2, loaded.order, loaded.root, frame);
  return loaded;
}

// Returns whether a triangle is in a leaf that a ray through a point of it reaches.
bool is_reached(const Loaded& loaded, std::uint32_t child, std::uint32_t triangle,
                const glm::vec3& point) {
  if (child == BVH_EMPTY) return false;
  if (child & BVH_LEAF) {
    for (std::uint32_t i = 0; i < hierarchy::size_of_leaf(child); ++i)
      if (loaded.order[hierarchy::first_of_leaf(child) + i] == triangle) return true;
    return false;
  }
  const gpu::BvhNode& node = loaded.nodes[child];
  for (int i = 0; i < 4; ++i) {
    if (node.child[i] == BVH_EMPTY) continue;
    bool is_inside = true;
    for (int axis = 0; axis < 3; ++axis) {
      const float step = std::ldexp(1.0f, int((node.exponents >> (8 * axis)) & 255u) - 127),
                  steps = (point[axis] - node.origin[axis]) / step;
      is_inside = is_inside && steps >= float((node.lower[axis] >> (8 * i)) & 255u) &&
                  steps <= float((node.upper[axis] >> (8 * i)) & 255u);
    }
    if (is_inside && is_reached(loaded, node.child[i], triangle, point)) return true;
  }
  return false;
}

TEST(StoredBvh, HoldsAllOfTrianglesThatItCuts) {
  const TriangleList triangles = long_triangles(4000, 1);
  const Built built = build_cut(triangles);
  const Loaded loaded = load_cut(triangles, built.stored);
  ASSERT_EQ(loaded.fault, "");
  EXPECT_GT(loaded.order.size(), triangles.size() + 200);
  std::mt19937 random(2);
  const auto uniform = [&] { return double(random() >> 8) / 16777216.0; };
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    for (int k = 0; k < 20; ++k) {
      const double u = uniform(), v = uniform() * (1 - u);
      const gpu::Triangle t = triangles[i];
      const glm::dvec3 a(t.v0);
      const glm::vec3 point(a + u * (glm::dvec3(t.v1) - a) + v * (glm::dvec3(t.v2) - a));
      ASSERT_TRUE(is_reached(loaded, loaded.root.node, i, point)) << i;
    }
}

// Returns the triangles in the order in which a traversal meets them, with the end of each leaf.
std::vector<std::uint32_t> order_of_leaves(const Loaded& loaded, std::uint32_t child) {
  std::vector<std::uint32_t> result;
  if (child == BVH_EMPTY) return result;
  if (child & BVH_LEAF) {
    const auto first = loaded.order.begin() + hierarchy::first_of_leaf(child);
    result.assign(first, first + hierarchy::size_of_leaf(child));
    result.push_back(hierarchy::no_child);
    return result;
  }
  for (const std::uint32_t below : loaded.nodes[child].child)
    for (const std::uint32_t number : order_of_leaves(loaded, below)) result.push_back(number);
  return result;
}

// Boxes that are measured from the leaves up may be smaller by what rounding took from a cut.
TEST(StoredBvh, IsCutAsTheBuilderCuts) {
  for (const hierarchy::BoxFrame& frame :
       {hierarchy::BoxFrame{}, hierarchy::BoxFrame{{0.8f, 0.6f}}}) {
    const TriangleList triangles = long_triangles(100'000, 4);
    const Built built = build_cut(triangles, frame);
    const Loaded loaded = load_cut(triangles, built.stored, frame);
    ASSERT_EQ(loaded.fault, "");
    LargeVector<std::uint32_t> order;
    Loaded made;
    made.root = append_cut_bvh(made.nodes, triangles, 0, triangles.size(), hierarchy::static_leaf,
                               hierarchy::static_stack, 3, order, frame);
    made.order.assign(order.begin(), order.end());
    EXPECT_GT(made.order.size(), triangles.size() + 5000);
    EXPECT_EQ(loaded.nodes.size(), made.nodes.size());
    EXPECT_EQ(loaded.root.stack_need, made.root.stack_need);
    EXPECT_EQ(order_of_leaves(loaded, loaded.root.node), order_of_leaves(made, made.root.node));
  }
}

// Positions of leaves have 27 bits.
TEST(StoredBvh, IsRefusedWhereItsPartsHaveNoRoom) {
  const TriangleList triangles = mixed_triangles(100, 1);
  const Built built = build_stored(triangles, 0);
  Loaded loaded;
  loaded.order.resize(triangles.size());
  const std::size_t most = BVH_LEAF_FIRST_MASK - triangles.size();
  for (const std::size_t more : {most, most + 1}) {
    const std::string fault =
        append_stored_bvh(loaded.nodes, triangles, 0, built.stored, hierarchy::static_leaf,
                          hierarchy::static_stack, 1, loaded.order, loaded.root, {}, more);
    EXPECT_EQ(fault.find("no room") != std::string::npos, more > most) << fault;
  }
}

// Whatever cuts a file holds, they are refused or all of each triangle is in leaves.
TEST(StoredBvh, NoCutsBreakIt) {
  const TriangleList triangles = long_triangles(800, 3);
  const Built built = build_cut(triangles);
  ASSERT_GT(built.encoded.cuts.size(), 20u);
  std::mt19937 random(1);
  int refused = 0, taken = 0;
  for (int round = 0; round < 1500; ++round) {
    std::vector<std::uint32_t> words(2 * built.encoded.cuts.size());
    std::memcpy(words.data(), built.encoded.cuts.data(), 4 * words.size());
    words[random() % words.size()] ^= 1u << random() % 32;
    StoredHierarchy stored = built.stored;
    stored.area_m2 = 1e30;
    stored.cuts = std::as_bytes(std::span(words));
    const Loaded loaded = load_cut(triangles, stored);
    ++(loaded.fault.empty() ? taken : refused);
    if (!loaded.fault.empty()) continue;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      const gpu::Triangle t = triangles[i];
      const glm::vec3 middle((glm::dvec3(t.v0) + glm::dvec3(t.v1) + glm::dvec3(t.v2)) / 3.0);
      for (const glm::vec3& point : {t.v0, t.v1, t.v2, middle})
        ASSERT_TRUE(is_reached(loaded, loaded.root.node, i, point)) << round << ' ' << i;
    }
  }
  EXPECT_GT(refused, 500);
  EXPECT_GT(taken, 100) << "a plane may be moved";
}

}  // namespace
}  // namespace nightcity::scene
