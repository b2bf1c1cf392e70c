#include "tools/traffic/link_table.h"

#include <algorithm>
#include <cmath>

namespace nightcity::traffic {

LinkTable::LinkTable(const LinkNetwork& network) {
  facts_.reserve(network.links().size());
  for (const Link& link : network.links()) {
    LinkFacts facts;
    facts.length_m = link.curve.length();
    facts.entry_m_s = link.allowed_m_s.front();
    facts.turn = link.turn;
    facts.junction = link.junction;
    if (link.turn) facts.node = static_cast<std::uint32_t>(network.graph().edges[link.edge].to);
    facts.first_conflict = static_cast<std::uint32_t>(conflicts_.size());
    facts.conflict_count = static_cast<std::uint32_t>(link.conflicts.size());
    conflicts_.insert(conflicts_.end(), link.conflicts.begin(), link.conflicts.end());
    facts.first_limit = static_cast<std::uint32_t>(limits_.size());
    facts.limit_count = static_cast<std::uint32_t>(link.allowed_m_s.size());
    for (std::size_t n = 0; n < link.allowed_m_s.size(); ++n)
      limits_.push_back({link.curve.samples()[n].s, link.allowed_m_s[n] * link.allowed_m_s[n]});
    facts_.push_back(facts);
  }
}

double LinkTable::speed_allowed(std::size_t link, double s, std::uint32_t& hint) const {
  const LinkFacts& facts = facts_[link];
  const Limit* const limits = limits_.data() + facts.first_limit;
  s = std::clamp(s, 0.0, facts.length_m);
  // The first limit behind s, but neither the first nor beyond the last one. From the hint it is
  // usually a step or two ahead; without one it is searched for.
  std::uint32_t after = hint == 0 ? facts.limit_count - 1 : hint;
  if (after > 1 && s < limits[after - 1].s)
    after = static_cast<std::uint32_t>(
        std::upper_bound(limits + 1, limits + after, s,
                         [](double value, const Limit& limit) { return value < limit.s; }) -
        limits);
  while (after + 1 < facts.limit_count && !(s < limits[after].s)) ++after;
  hint = after;
  const Limit &a = limits[after - 1], &b = limits[after];
  const double step = b.s - a.s, x = step > 0 ? (s - a.s) / step : 0;
  return std::sqrt(a.square + (b.square - a.square) * x);
}

}  // namespace nightcity::traffic
