#include "runtime/scene/stored_bvh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "formats/hierarchy/cutting_build.h"
#include "formats/hierarchy/static_geometry.h"
#include "formats/hierarchy/topology.h"
#include "runtime/scene/quantised_nodes.h"
#include "runtime/scene/triangle_pieces.h"

namespace nightcity::scene {
namespace {

// Quads, of which some are halves alone, and triangles of very different sizes.
TriangleList mixed_triangles(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](float a, float b) {
    return a + (b - a) * float(random() >> 8) / 16777216.0f;
  };
  TriangleList list;
  while (list.size() < count) {
    const float size = uniform(0.1f, 20);
    const glm::vec3 a(uniform(-500, 500), uniform(0, 30), uniform(-500, 500)),
        b = a + glm::vec3(size, 0, 0), c = a + glm::vec3(size, size, uniform(0, 1)),
        d = a + glm::vec3(0, size, 0);
    list.push_back({a, 0, b, 0, c, 0});
    if (random() % 4 != 0) list.push_back({a, 0, c, 0, d, 0});
  }
  return list;
}

struct Built {
  hierarchy::Encoded encoded;
  StoredHierarchy stored;
};

// As nightbake makes it.
Built build_stored(const TriangleList& triangles, std::size_t first,
                   const hierarchy::BoxFrame& frame = {}) {
  const std::size_t count = triangles.size() - first;
  Built built;
  hierarchy::Bounds box;
  auto pieces = make_pieces(triangles, first, count, true, frame, 1, box);
  LargeVector<hierarchy::BareNode> nodes;
  const hierarchy::Root root =
      hierarchy::ParallelBuild<hierarchy::PieceAccess<2>, hierarchy::BareNodes>(
          std::span(pieces), hierarchy::static_leaf, 2, nodes)
          .build(0, hierarchy::static_stack);
  std::vector<std::uint32_t> order;
  for (const hierarchy::TrianglePiece& piece : pieces)
    for (std::uint32_t i = 0; i < piece.count(); ++i) order.push_back(piece.first() + i);
  built.encoded = hierarchy::encode(nodes, root.node, order);
  built.stored.triangles = static_cast<std::uint32_t>(count);
  built.stored.along = frame.along;
  for (int axis = 0; axis < 3; ++axis) {
    built.stored.lower[axis] = box.lower[axis];
    built.stored.upper[axis] = box.upper[axis];
  }
  for (const hierarchy::BareNode& node : nodes) built.stored.area_m2 += double(node.area);
  built.stored.topology = std::as_bytes(std::span(built.encoded.topology));
  built.stored.order = std::as_bytes(std::span(built.encoded.order));
  return built;
}

struct Loaded {
  LargeVector<gpu::BvhNode> nodes;
  std::vector<std::uint32_t> order;
  BvhRoot root;
  std::string fault;
};

Loaded load_stored(const TriangleList& triangles, std::size_t first, const StoredHierarchy& stored,
                   unsigned threads = 2, std::size_t nodes_before = 0,
                   const hierarchy::BoxFrame& frame = {}) {
  Loaded loaded;
  loaded.nodes.resize(nodes_before);
  loaded.order.resize(triangles.size() - first);
  loaded.fault =
      append_stored_bvh(loaded.nodes, triangles, first, stored, hierarchy::static_leaf,
                        hierarchy::static_stack, threads, loaded.order, loaded.root, frame);
  return loaded;
}

// Compares nodes and leaves as a traversal meets them; where they lie may differ.
void expect_same(const Loaded& a, std::uint32_t of_a, const Loaded& b, std::uint32_t of_b,
                 std::size_t first) {
  ASSERT_EQ(of_a & BVH_LEAF, of_b & BVH_LEAF);
  if (of_a & BVH_LEAF) {
    ASSERT_EQ(hierarchy::size_of_leaf(of_a), hierarchy::size_of_leaf(of_b));
    for (std::uint32_t i = 0; i < hierarchy::size_of_leaf(of_a); ++i)
      ASSERT_EQ(a.order[hierarchy::first_of_leaf(of_a) - first + i],
                b.order[hierarchy::first_of_leaf(of_b) - first + i]);
    return;
  }
  const gpu::BvhNode &node = a.nodes[of_a], &other = b.nodes[of_b];
  ASSERT_EQ(node.origin, other.origin);
  ASSERT_EQ(node.exponents, other.exponents);
  ASSERT_EQ(node.masks, other.masks);
  for (int axis = 0; axis < 3; ++axis) {
    ASSERT_EQ(node.lower[axis], other.lower[axis]);
    ASSERT_EQ(node.upper[axis], other.upper[axis]);
  }
  for (int i = 0; i < 4; ++i) {
    ASSERT_EQ(node.child[i] == BVH_EMPTY, other.child[i] == BVH_EMPTY);
    if (node.child[i] != BVH_EMPTY) expect_same(a, node.child[i], b, other.child[i], first);
  }
}

TEST(StoredBvh, HasTheNodesThatTheBuilderMakes) {
  for (const std::size_t count : {1u, 4u, 5u, 300u, 200'000u})
    for (const std::size_t first : {std::size_t{0}, std::size_t{1}}) {
      if (first >= count) continue;
      const TriangleList triangles = mixed_triangles(count, unsigned(count));
      const Built built = build_stored(triangles, first);
      const Loaded loaded = load_stored(triangles, first, built.stored, 2, 7);
      ASSERT_EQ(loaded.fault, "") << count;
      Loaded made;
      made.order.resize(triangles.size() - first);
      made.root = append_bvh(made.nodes, triangles, first, hierarchy::static_leaf,
                             hierarchy::static_stack, 2, made.order);
      EXPECT_EQ(loaded.nodes.size(), made.nodes.size() + 7);
      EXPECT_EQ(loaded.root.stack_need, made.root.stack_need);
      EXPECT_EQ(loaded.root.box.lower, made.root.box.lower);
      EXPECT_EQ(loaded.root.box.upper, made.root.box.upper);
      expect_same(loaded, loaded.root.node, made, made.root.node, first);
    }
}

TEST(StoredBvh, HasBoxesThatLieAlongItsFrame) {
  const TriangleList triangles = mixed_triangles(30'000, 5);
  const hierarchy::BoxFrame frame{{0.8f, 0.6f}};
  const Built built = build_stored(triangles, 0, frame);
  const Loaded loaded = load_stored(triangles, 0, built.stored, 2, 0, frame);
  ASSERT_EQ(loaded.fault, "");
  Loaded made;
  made.order.resize(triangles.size());
  made.root = append_bvh(made.nodes, triangles, 0, hierarchy::static_leaf, hierarchy::static_stack,
                         2, made.order, frame);
  EXPECT_EQ(loaded.root.box.lower, made.root.box.lower);
  EXPECT_EQ(loaded.root.box.upper, made.root.box.upper);
  expect_same(loaded, loaded.root.node, made, made.root.node, 0);
  const Loaded other = load_stored(triangles, 0, built.stored, 2, 0, {{0.6f, 0.8f}});
  EXPECT_NE(other.fault.find("another direction"), std::string::npos) << other.fault;
}

// nightbake knows no margin, and its area is that of boxes without.
TEST(StoredBvh, HasTheMarginOfItsFrame) {
  const TriangleList triangles = mixed_triangles(30'000, 6);
  const Built built = build_stored(triangles, 0, {{0.8f, 0.6f}});
  const Loaded without = load_stored(triangles, 0, built.stored, 2, 0, {{0.8f, 0.6f}}),
               with = load_stored(triangles, 0, built.stored, 2, 0, {{0.8f, 0.6f}, 2.0f});
  ASSERT_EQ(with.fault, "");
  ASSERT_EQ(with.nodes.size(), without.nodes.size());
  EXPECT_EQ(with.root.box.lower, without.root.box.lower) << "that of the triangles";
  for (std::size_t i = 0; i < with.nodes.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_LT(with.nodes[i].origin[axis], without.nodes[i].origin[axis] - 1.9f) << i;
}

TEST(StoredBvh, HasTheSameBytesForAnyNumberOfThreads) {
  const TriangleList triangles = mixed_triangles(100'000, 3);
  const Built built = build_stored(triangles, 0);
  const Loaded one = load_stored(triangles, 0, built.stored, 1);
  for (const unsigned threads : {2u, 3u, 8u}) {
    const Loaded many = load_stored(triangles, 0, built.stored, threads);
    EXPECT_EQ(many.order, one.order);
    ASSERT_EQ(many.nodes.size(), one.nodes.size());
    EXPECT_EQ(
        std::memcmp(many.nodes.data(), one.nodes.data(), one.nodes.size() * sizeof one.nodes[0]), 0)
        << threads;
  }
}

TEST(StoredBvh, IsRefusedWhereItIsOfOtherTriangles) {
  const TriangleList triangles = mixed_triangles(1000, 1), more = mixed_triangles(1200, 1);
  const Built built = build_stored(triangles, 0);
  const auto expect_refused = [&](const TriangleList& list, const StoredHierarchy& stored,
                                  const char* words) {
    const Loaded loaded = load_stored(list, 0, stored, 2, 5);
    EXPECT_NE(loaded.fault.find(words), std::string::npos) << loaded.fault;
    EXPECT_EQ(loaded.nodes.size(), 5u) << "no node stays";
  };
  EXPECT_EQ(load_stored(triangles, 0, built.stored).fault, "");
  expect_refused(more, built.stored, "another number");
  TriangleList moved = triangles;
  for (gpu::Triangle& t : moved.stored()) t.v1.y -= 100;
  expect_refused(moved, built.stored, "another box");
  // The same triangles in another order fill the same box.
  TriangleList mixed = triangles;
  std::shuffle(mixed.stored().begin(), mixed.stored().end(), std::mt19937(2));
  expect_refused(mixed, built.stored, "larger");
  StoredHierarchy stored = built.stored;
  stored.area_m2 = NAN;
  expect_refused(triangles, stored, "larger");
}

TEST(StoredBvh, IsRefusedWhereItsNumbersAreWrong) {
  const TriangleList triangles = mixed_triangles(1000, 1);
  const Built built = build_stored(triangles, 0);
  const auto expect_refused = [&](const hierarchy::Encoded& encoded, const char* words) {
    StoredHierarchy stored = built.stored;
    stored.topology = std::as_bytes(std::span(encoded.topology));
    stored.order = std::as_bytes(std::span(encoded.order));
    const Loaded loaded = load_stored(triangles, 0, stored);
    EXPECT_NE(loaded.fault.find(words), std::string::npos) << loaded.fault;
    EXPECT_TRUE(loaded.nodes.empty());
  };
  hierarchy::Encoded wrong = built.encoded;
  wrong.topology.pop_back();
  expect_refused(wrong, "missing");
  wrong = built.encoded;
  wrong.topology.clear();
  expect_refused(wrong, "no node");
  wrong = built.encoded;
  wrong.order[1] = wrong.order[0];
  expect_refused(wrong, "twice");
  wrong = built.encoded;
  wrong.order.back() = hierarchy::leaf_first_mask;
  expect_refused(wrong, "not there");
  wrong = built.encoded;
  wrong.topology.assign(triangles.size() - 1, 0xF1);  // each a leaf of one, and a node
  wrong.topology.back() = 0x11;
  expect_refused(wrong, "deep");
}

// Whatever bytes a file holds, they are refused or give a hierarchy of all triangles.
TEST(StoredBvh, NoBytesBreakIt) {
  const TriangleList triangles = mixed_triangles(300, 1);
  const Built built = build_stored(triangles, 0);
  std::mt19937 random(1);
  int refused = 0;
  for (int round = 0; round < 3000; ++round) {
    hierarchy::Encoded wrong = built.encoded;
    for (unsigned i = 0; i <= random() % 3; ++i) {
      if (random() % 2)
        wrong.topology[random() % wrong.topology.size()] ^= std::uint16_t(1u << random() % 16);
      else
        wrong.order[random() % wrong.order.size()] ^= 1u << random() % 32;
    }
    StoredHierarchy stored = built.stored;
    stored.area_m2 = 1e30;
    stored.topology = std::as_bytes(std::span(wrong.topology));
    stored.order = std::as_bytes(std::span(wrong.order));
    const Loaded loaded = load_stored(triangles, 0, stored);
    refused += !loaded.fault.empty();
    if (!loaded.fault.empty()) continue;
    std::vector<std::uint32_t> sorted = loaded.order;
    std::sort(sorted.begin(), sorted.end());
    for (std::uint32_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(sorted[i], i);
    EXPECT_LE(loaded.root.stack_need, hierarchy::static_stack);
  }
  EXPECT_GT(refused, 2000);
}

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
