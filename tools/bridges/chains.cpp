#include "tools/bridges/chains.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

namespace nightcity::bridges {
namespace {

constexpr std::size_t none = ~std::size_t{0};

// Ends of ways are numbered: twice the way, and one more at its last node.
struct End {
  std::size_t number;
  glm::dvec2 away;  // unit, from the node into the way
};

class ChainJoiner {
 public:
  ChainJoiner(std::span<const PlacedWay> ways, const GroundNodes& ground)
      : ways_(ways), partner_(2 * ways.size(), none), used_(ways.size(), false) {
    std::map<std::pair<NodeKey, Carried>, std::vector<End>> meetings;
    for (std::size_t w = 0; w < ways.size(); ++w)
      for (const std::size_t end : {2 * w, 2 * w + 1})
        if (!ground.holds(node_of(end), ways[w].kind))
          meetings[{node_of(end), ways[w].kind}].push_back({end, find_direction(end)});
    for (const auto& [node, ends] : meetings) pair(ends);
  }

  std::vector<Chain> join() {
    std::vector<Chain> chains;
    for (const bool rings : {false, true})  // what is left when chains with ends are gone
      for (std::size_t w = 0; w < ways_.size(); ++w)
        for (const std::size_t end : {2 * w, 2 * w + 1})
          if (!used_[w] && (rings || partner_[end] == none)) chains.push_back(walk(end));
    return chains;
  }

 private:
  NodeKey node_of(std::size_t end) const {
    const auto& lon_lat = ways_[end / 2].lon_lat;
    return to_key(end % 2 == 0 ? lon_lat.front() : lon_lat.back());
  }
  glm::dvec2 find_direction(std::size_t end) const {
    const auto& line = ways_[end / 2].line;
    return glm::normalize(end % 2 == 0 ? line[1] - line[0] : line[line.size() - 2] - line.back());
  }

  void pair(const std::vector<End>& ends) {
    std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;  // straightest first
    for (std::size_t a = 0; a < ends.size(); ++a)
      for (std::size_t b = a + 1; b < ends.size(); ++b)
        pairs.emplace_back(glm::dot(ends[a].away, ends[b].away), ends[a].number, ends[b].number);
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [bend, a, b] : pairs)
      if (partner_[a] == none && partner_[b] == none) partner_[a] = b, partner_[b] = a;
  }

  // Follows a chain from an end of its first way.
  Chain walk(std::size_t end) {
    Chain chain;
    chain.kind = ways_[end / 2].kind;
    chain.layer = ways_[end / 2].layer;
    for (; end != none && !used_[end / 2]; end = partner_[end ^ 1]) {
      const PlacedWay& way = ways_[end / 2];
      used_[end / 2] = true;
      chain.parts.push_back({end / 2, end % 2 == 1});
      chain.layer = std::max(chain.layer, way.layer);
      chain.half_m = std::max(chain.half_m, way.half_m);
    }
    lay_line(chain);
    if (chain.nodes.back() < chain.nodes.front()) turn(chain);
    return chain;
  }

  void lay_line(Chain& chain) const {
    for (const Chain::Part& part : chain.parts) {
      const PlacedWay& way = ways_[part.way];
      for (std::size_t i = 0; i < way.line.size(); ++i) {
        const std::size_t n = part.reversed ? way.line.size() - 1 - i : i;
        if (!chain.line.empty() && chain.line.back() == way.line[n]) continue;
        chain.line.push_back(way.line[n]);
        chain.nodes.push_back(to_key(way.lon_lat[n]));
      }
    }
  }

  static void turn(Chain& chain) {
    std::reverse(chain.parts.begin(), chain.parts.end());
    for (Chain::Part& part : chain.parts) part.reversed = !part.reversed;
    std::reverse(chain.line.begin(), chain.line.end());
    std::reverse(chain.nodes.begin(), chain.nodes.end());
  }

  std::span<const PlacedWay> ways_;
  std::vector<std::size_t> partner_;  // of each end
  std::vector<bool> used_;            // of each way
};

}  // namespace

std::vector<Chain> join_chains(std::span<const PlacedWay> ways, const GroundNodes& ground) {
  return ChainJoiner(ways, ground).join();
}

}  // namespace nightcity::bridges
