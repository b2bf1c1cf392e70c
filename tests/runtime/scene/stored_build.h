// Hierarchies as nightbake stores them and nightview loads them.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "formats/hierarchy/cutting_build.h"
#include "formats/hierarchy/static_geometry.h"
#include "formats/hierarchy/topology.h"
#include "runtime/scene/quantised_nodes.h"
#include "runtime/scene/stored_bvh.h"
#include "runtime/scene/triangle_pieces.h"

namespace nightcity::scene {

// Quads, of which some are halves alone, and triangles of very different sizes.
inline TriangleList mixed_triangles(std::size_t count, unsigned seed) {
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
inline Built build_stored(const TriangleList& triangles, std::size_t first,
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

inline Loaded load_stored(const TriangleList& triangles, std::size_t first,
                          const StoredHierarchy& stored, unsigned threads = 2,
                          std::size_t nodes_before = 0, const hierarchy::BoxFrame& frame = {}) {
  Loaded loaded;
  loaded.nodes.resize(nodes_before);
  loaded.order.resize(triangles.size() - first);
  loaded.fault =
      append_stored_bvh(loaded.nodes, triangles, first, stored, hierarchy::static_leaf,
                        hierarchy::static_stack, threads, loaded.order, loaded.root, frame);
  return loaded;
}

// Compares nodes and leaves as a traversal meets them; where they lie may differ.
inline void expect_same(const Loaded& a, std::uint32_t of_a, const Loaded& b, std::uint32_t of_b,
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

}  // namespace nightcity::scene
