// The facts about links that the simulation needs at every step, packed together for the cache.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/traffic/link_network.h"

namespace nightcity::traffic {

struct LinkFacts {
  double length_m = 0;
  double entry_m_s = 0;  // speed allowed at the start
  bool turn = false, junction = false;
  std::uint32_t node = 0;  // of a turn: the node where it lies
  std::uint32_t first_conflict = 0, conflict_count = 0;
  std::uint32_t first_limit = 0, limit_count = 0;
};

class LinkTable {
 public:
  /// Copies all it needs from the network.
  explicit LinkTable(const LinkNetwork& network);

  std::size_t size() const { return facts_.size(); }
  const LinkFacts& operator[](std::size_t link) const { return facts_[link]; }
  std::span<const Conflict> conflicts(std::size_t link) const {
    return std::span(conflicts_).subspan(facts_[link].first_conflict, facts_[link].conflict_count);
  }
  /// Returns the speed in m/s that the limit, the bends and the braking for what lies ahead on this
  /// link allow at `s` metres from its start; `s` is clamped to the link.
  double speed_allowed(std::size_t link, double s) const {
    std::uint32_t hint = 0;
    return speed_allowed(link, s, hint);
  }
  /// Does the same, the faster the nearer `hint` was: it is set to where the limit was found.
  double speed_allowed(std::size_t link, double s, std::uint32_t& hint) const;

 private:
  struct Limit {
    double s, square;  // squared speed: under even braking it is linear in the distance
  };

  std::vector<LinkFacts> facts_;
  std::vector<Conflict> conflicts_;
  std::vector<Limit> limits_;
};

}  // namespace nightcity::traffic
