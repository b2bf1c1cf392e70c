// What the simulation asks of links at every step, packed: links themselves lie all over the memory.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/traffic/link_network.h"

namespace nightcity::traffic {

struct LinkFacts {
  double length_m = 0;
  double entry_m_s = 0;  // speed allowed at its start
  bool turn = false, junction = false;
  std::uint32_t node = 0;  // a turn's: where it lies
  std::uint32_t first_conflict = 0, conflict_count = 0;
  std::uint32_t first_limit = 0, limit_count = 0;
};

class LinkTable {
 public:
  /// Copies what it needs.
  explicit LinkTable(const LinkNetwork& network);

  std::size_t size() const { return facts_.size(); }
  const LinkFacts& operator[](std::size_t link) const { return facts_[link]; }
  std::span<const Conflict> conflicts(std::size_t link) const {
    return std::span(conflicts_).subspan(facts_[link].first_conflict, facts_[link].conflict_count);
  }
  /// By limit, bends, and braking for what lies ahead on this link; `s` is clamped to it.
  double speed_allowed(std::size_t link, double s) const;

 private:
  struct Limit {
    double s, square;  // of the speed: braking is even along the way in v squared
  };

  std::vector<LinkFacts> facts_;
  std::vector<Conflict> conflicts_;
  std::vector<Limit> limits_;
};

}  // namespace nightcity::traffic
