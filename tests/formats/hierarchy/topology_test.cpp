#include "formats/hierarchy/topology.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <set>

#include "formats/hierarchy/static_geometry.h"
#include "formats/hierarchy/triangle_pieces.h"

namespace nightcity::hierarchy {
namespace {

std::span<const std::byte> bytes_of(const auto& numbers) {
  return std::as_bytes(std::span(numbers));
}

// Children of a node in the order of the file.
std::uint16_t node_of(std::uint32_t a, std::uint32_t b, std::uint32_t c = 0, std::uint32_t d = 0) {
  return static_cast<std::uint16_t>(a | b << 4 | c << 8 | d << 12);
}
constexpr std::uint32_t below = child_is_node;

std::string refusal_of(const std::vector<std::uint16_t>& nodes, std::uint32_t triangles,
                       std::uint32_t stack = static_stack) {
  Topology topology;
  return decode_topology(bytes_of(nodes), triangles, static_leaf, stack, topology);
}

std::string order_refusal(const std::vector<std::uint32_t>& entries, std::size_t triangles) {
  std::vector<std::uint32_t> order(triangles);
  return decode_order(bytes_of(entries), 0, order);
}

// Boxes of single triangles that lie anywhere.
LargeVector<TrianglePiece> random_pieces(std::uint32_t count, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return 100 * float(random() >> 8) / 16777216.0f; };
  LargeVector<TrianglePiece> pieces;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Float4 lower{uniform(), uniform(), uniform(), 0};
    pieces.emplace_back(Bounds{lower, lower + Float4{1, 1, 1, 0}}, i, 1);
  }
  return pieces;
}

// Two leaves below the root, another two below its second child, by hand.
TEST(Topology, IsWrittenAsATraversalMeetsIt) {
  const std::vector<BareNode> nodes{
      {{make_leaf(4, 2), 1, no_child, no_child}, 0},
      {{make_leaf(0, 3), make_leaf(3, 1), make_leaf(6, 4), no_child}, 0}};
  const std::vector<std::uint32_t> order{9, 8, 7, 0, 5, 6, 1, 2, 3, 4};
  const Encoded encoded = encode(nodes, 0, order);
  EXPECT_EQ(encoded.topology, (std::vector<std::uint16_t>{node_of(2, below), node_of(3, 1, 4)}));
  // 5 6, 9, 8, 7, 0 1 2 3 4.
  EXPECT_EQ(encoded.order,
            (std::vector<std::uint32_t>{5u | 1u << run_shift, 9, 8, 7, 0u | 4u << run_shift}));
  Topology topology;
  EXPECT_EQ(decode_topology(bytes_of(encoded.topology), 10, 4, 3, topology), "");
  EXPECT_EQ(topology.nodes, (std::vector<std::uint32_t>{2, 1}));
  EXPECT_EQ(topology.triangles, (std::vector<std::uint32_t>{10, 8}));
  EXPECT_EQ(topology.stack_need, 3u) << "one at the root, two below";
  std::vector<std::uint32_t> read(10);
  EXPECT_EQ(decode_order(bytes_of(encoded.order), 100, read), "");
  EXPECT_EQ(read, (std::vector<std::uint32_t>{105, 106, 109, 108, 107, 100, 101, 102, 103, 104}));
}

TEST(Topology, OfWhatTheBuilderMakesIsReadAsItWasWritten) {
  for (const std::uint32_t count : {1u, 4u, 5u, 40u, 100'000u}) {
    LargeVector<TrianglePiece> pieces = random_pieces(count, count);
    LargeVector<BareNode> nodes;
    const Root root =
        ParallelBuild<PieceAccess<2>, BareNodes>(std::span(pieces), static_leaf, 2, nodes)
            .build(0, static_stack);
    std::vector<std::uint32_t> order;
    for (const TrianglePiece& piece : pieces) order.push_back(piece.first());
    const Encoded encoded = encode(nodes, root.node, order);
    EXPECT_EQ(encoded.topology.size(), nodes.size());
    Topology topology;
    ASSERT_EQ(
        decode_topology(bytes_of(encoded.topology), count, static_leaf, static_stack, topology), "")
        << count;
    EXPECT_EQ(topology.stack_need, root.stack_need);
    std::vector<std::uint32_t> read(count);
    ASSERT_EQ(decode_order(bytes_of(encoded.order), 0, read), "") << count;
    EXPECT_EQ(std::set<std::uint32_t>(read.begin(), read.end()).size(), count);
  }
}

TEST(Topology, LongRunsOfTrianglesAreCut) {
  std::vector<BareNode> chain;
  std::vector<std::uint32_t> order(100);
  std::iota(order.begin(), order.end(), 0u);
  for (std::uint32_t i = 0; i < 24; ++i)
    chain.push_back(
        {{make_leaf(4 * i, 4), i < 23 ? i + 1 : make_leaf(96, 4), no_child, no_child}, 0});
  const Encoded encoded = encode(chain, 0, order);
  EXPECT_EQ(encoded.order.size(), 4u) << "32, 32, 32 and 4";
  std::vector<std::uint32_t> read(100);
  EXPECT_EQ(decode_order(bytes_of(encoded.order), 0, read), "");
  EXPECT_EQ(read, order);
}

TEST(Topology, ThatIsNoTreeIsRefused) {
  EXPECT_EQ(refusal_of({node_of(4, below), node_of(4, 4)}, 12), "");
  EXPECT_EQ(refusal_of({}, 4), "") << "one leaf";
  for (const auto& [nodes, triangles] :
       std::vector<std::pair<std::vector<std::uint16_t>, unsigned>>{
           {{}, 0},
           {{}, 5},
           {{node_of(4, below)}, 12},                                    // a node is missing
           {{node_of(4, 4), node_of(4, 4)}, 16},                         // one is below no other
           {{node_of(below, below), node_of(4, 4)}, 8},                  // of two, one is missing
           {{node_of(4, below), node_of(4, 4)}, 11},                     // too many triangles
           {{node_of(4, below), node_of(4, 4)}, 13},                     // too few
           {{node_of(4, below), node_of(below, 0), node_of(4, 4)}, 12},  // one child alone
           {{node_of(4, below), 0}, 12},                                 // no child
           {{node_of(4, 0, below), node_of(4, 4)}, 12},                  // a gap
           {{node_of(5, below), node_of(4, 3)}, 12},                     // a leaf that is too large
           {{node_of(1, 1), node_of(1, 1), node_of(1, 1)}, 3},  // more nodes than triangles
       })
    EXPECT_NE(refusal_of(nodes, triangles), "") << nodes.size() << " nodes, " << triangles;
  const std::vector<std::uint8_t> odd{0x44, 0, 0};
  Topology topology;
  EXPECT_NE(decode_topology(bytes_of(odd), 8, 4, 46, topology), "") << "half a node";
}

// A ray defers one child of each node of a chain.
TEST(Topology, ThatIsTooDeepForTheStackIsRefused) {
  std::vector<std::uint16_t> chain;
  for (int i = 0; i < 9; ++i) chain.push_back(node_of(1, below));
  chain.push_back(node_of(1, 1));
  EXPECT_EQ(refusal_of(chain, 11, 10), "");
  EXPECT_EQ(refusal_of(chain, 11, 9), "it is too deep");
  chain.assign(1'000'000, node_of(1, below));
  chain.back() = node_of(1, 1);
  EXPECT_EQ(refusal_of(chain, 1'000'001), "it is too deep");
}

TEST(Topology, AnOrderThatIsNoPermutationIsRefused) {
  EXPECT_EQ(order_refusal({2, 0u | 1u << run_shift}, 3), "");
  EXPECT_NE(order_refusal({2, 1u | 1u << run_shift}, 3), "") << "2 twice";
  EXPECT_NE(order_refusal({2, 0, 3}, 3), "") << "beyond the last";
  EXPECT_NE(order_refusal({2, 0}, 3), "") << "too few";
  EXPECT_NE(order_refusal({2, 0, 1, 0}, 3), "") << "too many";
  EXPECT_NE(order_refusal({0u | 31u << run_shift}, 3), "") << "a run beyond the end";
  EXPECT_NE(order_refusal({0xFFFFFFFF}, 3), "");
  std::vector<std::uint32_t> order(1);
  EXPECT_NE(decode_order(bytes_of(std::vector<std::uint8_t>(5)), 0, order), "") << "half a number";
}

}  // namespace
}  // namespace nightcity::hierarchy
