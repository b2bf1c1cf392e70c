#include "tools/streets/axis_cleaning.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace nightcity::streets {
namespace {

using glm::dvec2;
using Branch = Axis::Branch;

// Beyond the edge of the street that it leaves; shorter ones are bays or corners.
constexpr double shortest_stub_m = 8;

void reverse(Branch& branch) {
  std::swap(branch.from, branch.to);
  std::reverse(branch.line.begin(), branch.line.end());
  std::reverse(branch.width_m.begin(), branch.width_m.end());
}

class Cleaner {
 public:
  explicit Cleaner(Axis&& axis)
      : nodes_(std::move(axis.nodes)), branches_(std::move(axis.branches)) {
    std::erase_if(branches_, [](const Branch& branch) { return branch.line.size() < 2; });
  }

  Axis run() {
    while (prune() + join() > 0) {
    }
    contract();
    while (prune() + join() > 0) {
    }
    close_rings();
    return {std::move(nodes_), std::move(branches_)};
  }

 private:
  BranchesAt branches_at() const { return list_branches_at(nodes_.size(), branches_); }

  void remove(const std::vector<bool>& gone) {
    std::size_t kept = 0;
    for (std::size_t b = 0; b < branches_.size(); ++b)
      if (!gone[b]) std::swap(branches_[kept++], branches_[b]);
    branches_.resize(kept);
  }

  /// Removes spurs that reach no farther than a corner of their junction. At the end of a street
  /// all of them are removed at once, and the street ends between them.
  std::size_t prune() {
    const auto at = branches_at();
    std::vector<bool> gone(branches_.size(), false);
    std::size_t count = 0;
    for (std::size_t node = 0; node < nodes_.size(); ++node) {
      if (at[node].size() < 3) continue;
      for (const std::size_t b : at[node]) {
        const Branch& branch = branches_[b];
        const std::size_t end = branch.from == node ? branch.to : branch.from;
        if (end == node || at[end].size() != 1) continue;
        double beyond = 0;
        for (const dvec2& tip : nodes_[end].tips)
          beyond = std::max(beyond, glm::distance(tip, nodes_[end].place));
        if (length_of(branch.line) + beyond > nodes_[node].reach_m / 2 + shortest_stub_m) continue;
        gone[b] = true;
        ++count;
        auto& tips = nodes_[node].tips;
        tips.insert(tips.end(), nodes_[end].tips.begin(), nodes_[end].tips.end());
      }
    }
    remove(gone);
    return count;
  }

  /// Joins two branches if only they are left at a node.
  std::size_t join() {
    auto at = branches_at();
    std::vector<bool> gone(branches_.size(), false);
    std::size_t count = 0;
    for (std::size_t node = 0; node < nodes_.size(); ++node) {
      if (at[node].size() != 2 || at[node][0] == at[node][1]) continue;
      const std::size_t first = at[node][0], second = at[node][1];
      Branch &a = branches_[first], &b = branches_[second];
      if (a.to != node) reverse(a);
      if (b.from != node) reverse(b);
      // The node itself, inside a triangle, lies off the line between the chords beside it.
      a.line.pop_back();
      a.line.insert(a.line.end(), b.line.begin() + 1, b.line.end());
      a.width_m.back() = 0;
      a.width_m.insert(a.width_m.end(), b.width_m.begin() + 1, b.width_m.end());
      a.to = b.to;
      std::replace(at[b.to].begin(), at[b.to].end(), second, first);
      gone[second] = true;
      ++count;
    }
    remove(gone);
    return count;
  }

  /// A branch from a node to itself has no junction if nothing else meets it there.
  void close_rings() {
    const auto at = branches_at();
    for (Branch& branch : branches_) {
      if (branch.from != branch.to || at[branch.from].size() != 2 || branch.line.size() < 5)
        continue;
      Axis::Node& node = nodes_[branch.from];
      if (node.reach_m == 0) continue;
      branch.line.erase(branch.line.begin());
      branch.line.back() = node.place = branch.line.front();
      branch.width_m.erase(branch.width_m.begin());
      node.reach_m = 0;
    }
  }

  /// Merges junctions that are nearer to each other than they are wide, because four arms never
  /// meet in one triangle.
  void contract() {
    std::vector<std::size_t> into(nodes_.size());
    for (std::size_t n = 0; n < into.size(); ++n) into[n] = n;
    const auto root = [&](std::size_t n) {
      while (into[n] != n) n = into[n] = into[into[n]];
      return n;
    };
    const auto at = branches_at();
    std::vector<bool> gone(branches_.size(), false);
    for (std::size_t b = 0; b < branches_.size(); ++b) {
      const Branch& branch = branches_[b];
      if (at[branch.from].size() < 3 || at[branch.to].size() < 3) continue;
      const double reach = std::max(nodes_[branch.from].reach_m, nodes_[branch.to].reach_m);
      if (branch.from == branch.to || length_of(branch.line) > std::min(reach, widest_street_m))
        continue;
      gone[b] = true;
      into[root(branch.from)] = root(branch.to);
    }
    std::vector<dvec2> sums(nodes_.size(), dvec2(0));
    std::vector<double> counts(nodes_.size(), 0), reach(nodes_.size(), 0);
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (at[n].empty()) continue;
      sums[root(n)] += nodes_[n].place;
      ++counts[root(n)];
      reach[root(n)] = std::max(reach[root(n)], nodes_[n].reach_m);
    }
    for (std::size_t n = 0; n < nodes_.size(); ++n)
      if (counts[n] > 0) nodes_[n].place = sums[n] / counts[n], nodes_[n].reach_m = reach[n];
    for (std::size_t b = 0; b < branches_.size(); ++b) {
      Branch& branch = branches_[b];
      branch.from = root(branch.from);
      branch.to = root(branch.to);
      // This branch runs round an island within the junction.
      if (branch.from == branch.to && at[branch.from].size() >= 3 &&
          length_of(branch.line) < 2 * nodes_[branch.from].reach_m)
        gone[b] = true;
    }
    remove(gone);
  }

  std::vector<Axis::Node> nodes_;
  std::vector<Branch> branches_;
};

}  // namespace

BranchesAt list_branches_at(std::size_t nodes, std::span<const Axis::Branch> branches) {
  BranchesAt at(nodes);
  for (std::size_t b = 0; b < branches.size(); ++b) {
    at[branches[b].from].push_back(b);
    at[branches[b].to].push_back(b);
  }
  return at;
}

double length_of(std::span<const dvec2> line) {
  double sum = 0;
  for (std::size_t n = 1; n < line.size(); ++n) sum += glm::distance(line[n - 1], line[n]);
  return sum;
}

Axis clean_axis(Axis&& axis) {
  return Cleaner(std::move(axis)).run();
}

}  // namespace nightcity::streets
