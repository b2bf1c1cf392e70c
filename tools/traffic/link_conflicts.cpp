// The conflicts of a road network: where turns at a junction come too near each other, and which of
// two gives way.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <vector>

#include "tools/traffic/link_network.h"

namespace nightcity::traffic {

// Returns whether turn a gives way to turn b. First go vehicles in a roundabout before those that
// enter it, main road before minor road; on equal roads, oncoming traffic before a turn across it;
// otherwise traffic from the side of the kerb (right before left where people drive on the right).
bool LinkNetwork::yields(const Link& a, const Link& b) const {
  const RoadEdge &own = graph_.edges[a.edge], &other = graph_.edges[b.edge];
  if (a.edge == b.edge) return false;
  if (own.roundabout != other.roundabout) return other.roundabout;
  if (own.road->rank != other.road->rank) return own.road->rank < other.road->rank;
  const double angle = angle_between(find_end_direction(own), find_end_direction(other));
  const bool right_hand = graph_.side == Side::right;
  if (std::abs(angle) > 2.6) {
    const Movement across = right_hand ? Movement::left : Movement::right;
    return movement(a.edge, a.next_edge) == across && movement(b.edge, b.next_edge) != across;
  }
  // Traffic from the right drives towards the left, so its direction is turned by a positive angle.
  return right_hand ? angle > 0 : angle < 0;
}

void LinkNetwork::conflict(std::size_t number, std::size_t other_number) {
  Link &a = links_[number], &b = links_[other_number];
  const auto& sa = a.curve.samples();
  const auto& sb = b.curve.samples();
  double begin[2] = {1e9, 1e9}, end[2] = {-1e9, -1e9};
  for (const Curve::Sample& p : sa)
    for (const Curve::Sample& q : sb) {
      const double cosine = std::abs(glm::dot(glm::dvec2(p.along), glm::dvec2(q.along)));
      const double clear =
          cosine > 0.87 ? 2.1
                        : 2.9;  // across each other, the corners reach farther than side by side
      const glm::dvec2 apart = glm::dvec2(p.point - q.point);
      if (glm::dot(apart, apart) >= clear * clear || std::abs(p.point.z - q.point.z) > 3) continue;
      begin[0] = std::min(begin[0], p.s), end[0] = std::max(end[0], p.s);
      begin[1] = std::min(begin[1], q.s), end[1] = std::max(end[1], q.s);
    }
  Conflict::Kind kind = Conflict::Kind::cross;
  if (a.from == b.from)
    kind = Conflict::Kind::diverge;
  else if (a.to == b.to)
    kind = Conflict::Kind::merge;
  if (begin[0] > end[0]) return;
  const bool a_yields = kind != Conflict::Kind::diverge && yields(a, b);
  const bool b_yields = kind != Conflict::Kind::diverge && yields(b, a);
  a.conflicts.push_back({other_number, begin[0], end[0], begin[1], end[1], kind, a_yields});
  b.conflicts.push_back({number, begin[1], end[1], begin[0], end[0], kind, b_yields});
}

void LinkNetwork::find_conflicts() {
  std::map<std::size_t, std::vector<std::size_t>> at_node;
  for (std::size_t n = 0; n < links_.size(); ++n)
    if (links_[n].turn) {
      at_node[graph_.edges[links_[n].edge].to].push_back(n);
      links_[n].conflicts.clear();
    }
  for (const auto& [node, turns] : at_node)
    for (std::size_t a = 0; a < turns.size(); ++a)
      for (std::size_t b = a + 1; b < turns.size(); ++b) conflict(turns[a], turns[b]);
  for (Link& link : links_)
    link.junction =
        std::any_of(link.conflicts.begin(), link.conflicts.end(),
                    [](const Conflict& c) { return c.kind != Conflict::Kind::diverge; });
}

}  // namespace nightcity::traffic
