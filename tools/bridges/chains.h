// Chains of bridge ways: the ways that one deck carries, from end to end.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <set>
#include <span>
#include <vector>

#include "tools/bridges/bridge_way.h"

namespace nightcity::bridges {

/// The nodes at which ways that are no bridges lie on the ground, by what these carry. Steps and
/// lifts lead up to a bridge, and are left out.
struct GroundNodes {
  std::array<std::set<NodeKey>, 3> of_kind;
  bool holds(const NodeKey& node, Carried kind) const {
    return of_kind[static_cast<std::size_t>(kind)].contains(node);
  }
  /// Returns whether a bridge of a kind comes down to the ground at a node.
  bool is_abutment(const NodeKey& node, Carried kind) const {
    if (kind == Carried::rail) return holds(node, kind);
    return holds(node, Carried::street) || holds(node, Carried::path);
  }
};

struct Chain {
  struct Part {
    std::size_t way;  // into the ways
    bool reversed;    // the chain runs against it
  };
  std::vector<Part> parts;
  Carried kind = Carried::street;
  int layer = 0;                 // the highest of its ways
  double half_m = 0;             // half the width of its deck: that of the widest
  std::vector<glm::dvec2> line;  // E, N, m
  std::vector<NodeKey> nodes;    // of the same points
  bool is_ring() const { return nodes.front() == nodes.back(); }
};

/// Joins ways of one kind where they meet end to end, those that go on straightest first; a street
/// or track on the ground that meets them there ends both. Each of `ways` has two points or
/// more. A chain begins at the lesser of its end nodes, so the directions of ways do not matter.
std::vector<Chain> join_chains(std::span<const PlacedWay> ways, const GroundNodes& ground);

}  // namespace nightcity::bridges
