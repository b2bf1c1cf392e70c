#include "runtime/scene/stored_bvh.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "tests/runtime/scene/stored_build.h"

namespace nightcity::scene {
namespace {

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

}  // namespace
}  // namespace nightcity::scene
