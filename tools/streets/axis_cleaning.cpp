#include "tools/streets/axis_cleaning.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace nightcity::streets {
namespace {

using glm::dvec2;
using Branch = Axis::Branch;

constexpr double shortest_stub_m =
    8;  // beyond the edge of the street that it leaves; shorter ones are bays or corners
constexpr double straight_within_m = 0.4;  // deviation at which points of a line are removed
constexpr double widest_m = 60;

double length_of(const std::vector<dvec2>& line) {
  double sum = 0;
  for (std::size_t n = 1; n < line.size(); ++n) sum += glm::distance(line[n - 1], line[n]);
  return sum;
}

/// Returns the point at `s` along a line.
dvec2 place_on(const std::vector<dvec2>& line, double s) {
  for (std::size_t n = 1; n < line.size(); ++n) {
    const double step = glm::distance(line[n - 1], line[n]);
    if (s <= step && step > 0) return glm::mix(line[n - 1], line[n], std::max(s, 0.0) / step);
    s -= step;
  }
  return line.back();
}

void reverse(Branch& branch) {
  std::swap(branch.from, branch.to);
  std::reverse(branch.line.begin(), branch.line.end());
  std::reverse(branch.width_m.begin(), branch.width_m.end());
}

/// The median width of a branch: half of its length is no wider.
double median_width(const Branch& branch) {
  std::vector<std::pair<double, double>> widths;  // and the length that is so wide
  double sum = 0;
  for (std::size_t n = 0; n < branch.width_m.size(); ++n) {
    const double length = glm::distance(branch.line[n], branch.line[n + 1]);
    if (branch.width_m[n] <= 0 || length <= 0) continue;
    widths.emplace_back(branch.width_m[n], length);
    sum += length;
  }
  std::sort(widths.begin(), widths.end());
  double half = sum / 2;
  for (const auto& [width, length] : widths)
    if ((half -= length) <= 0) return width;
  return 0;
}

/// Simplifies a line (Douglas and Peucker 1973).
void simplify(const std::vector<dvec2>& line, std::size_t a, std::size_t b,
              std::vector<dvec2>& result) {
  double worst = straight_within_m;
  std::size_t at = a;
  const dvec2 chord = line[b] - line[a];
  const double length2 = glm::dot(chord, chord);
  for (std::size_t n = a + 1; n < b; ++n) {
    const double t =
        length2 > 0 ? std::clamp(glm::dot(line[n] - line[a], chord) / length2, 0.0, 1.0) : 0;
    const double off = glm::distance(line[n], line[a] + chord * t);
    if (off > worst) worst = off, at = n;
  }
  if (at == a) {
    result.push_back(line[b]);
    return;
  }
  simplify(line, a, at, result);
  simplify(line, at, b, result);
}

class Cleaner {
 public:
  explicit Cleaner(Axis&& axis)
      : nodes_(std::move(axis.nodes)), branches_(std::move(axis.branches)) {
    std::erase_if(branches_, [](const Branch& branch) { return branch.line.size() < 2; });
  }

  std::vector<Centreline> run() {
    while (prune() + join() > 0) {
    }
    contract();
    while (prune() + join() > 0) {
    }
    close_rings();
    for (const Branch& branch : branches_)
      widths_.push_back(std::min(median_width(branch), widest_m));
    find_places();
    std::vector<Centreline> result;
    for (std::size_t b = 0; b < branches_.size(); ++b) {
      Centreline street;
      street.from = branches_[b].from;
      street.to = branches_[b].to;
      street.width_m = widths_[b];
      const std::vector<dvec2> line = straightened(b);
      street.line.push_back(line.front());
      simplify(line, 0, line.size() - 1, street.line);
      if (street.width_m > 0 && length_of(street.line) > 0.5) result.push_back(std::move(street));
    }
    return result;
  }

 private:
  std::vector<std::vector<std::size_t>> branches_at() const {
    std::vector<std::vector<std::size_t>> at(nodes_.size());
    for (std::size_t b = 0; b < branches_.size(); ++b) {
      at[branches_[b].from].push_back(b);
      at[branches_[b].to].push_back(b);  // a ring is listed twice
    }
    return at;
  }

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
      if (branch.from == branch.to || length_of(branch.line) > std::min(reach, widest_m)) continue;
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

  /// The straight line on which a branch reaches the node at its start or end, where the junction
  /// does not yet bend the axis.
  struct Arm {
    dvec2 point, away;  // unit, from the node
    double cut;         // along the branch, to `point`
  };
  Arm arm(std::size_t b, bool at_start) const {
    std::vector<dvec2> line = branches_[b].line;
    if (!at_start) std::reverse(line.begin(), line.end());
    const Axis::Node& node = nodes_[at_start ? branches_[b].from : branches_[b].to];
    const double length = length_of(line), own = widths_[b];
    const double cut = std::min(0.6 * std::max(node.reach_m, own) + own / 2, 0.4 * length);
    const double span = std::min(std::max(own, 4.0), 0.4 * length);
    const dvec2 a = place_on(line, cut), c = place_on(line, cut + span);
    const double apart = glm::distance(a, c);
    return {a, apart > 1e-6 ? (c - a) / apart : dvec2(1, 0), cut};
  }

  /// Moves junctions to where the straight lines of their arms meet (least squares), and dead ends
  /// to the end of the outline.
  void find_places() {
    const auto at = branches_at();
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (at[n].empty()) continue;
      Axis::Node& node = nodes_[n];
      std::vector<Arm> arms;
      for (std::size_t k = 0; k < at[n].size(); ++k) {
        const Branch& branch = branches_[at[n][k]];
        const bool ring = branch.from == branch.to;  // its two ends follow each other
        arms.push_back(arm(at[n][k], ring ? k == 0 || at[n][k - 1] != at[n][k] : branch.from == n));
      }
      if (at[n].size() == 1) {
        double beyond = 0;
        for (const dvec2& tip : node.tips)
          beyond = std::max(beyond, glm::dot(tip - arms[0].point, -arms[0].away));
        node.place =
            arms[0].point - arms[0].away * std::clamp(beyond, 0.0, arms[0].cut + widest_m / 2);
      } else if (at[n].size() > 2) {
        node.place = meeting(arms, node.place, node.reach_m);
      }
    }
  }

  static dvec2 meeting(const std::vector<Arm>& arms, const dvec2& middle, double reach) {
    // The sum of (I - d d^T). A small multiple of I keeps parallel arms from moving the
    // point far away.
    double xx = 0.02, xy = 0, yy = 0.02;
    dvec2 right = middle * 0.02;
    for (const Arm& one : arms) {
      const dvec2 d = one.away;
      const double a = 1 - d.x * d.x, b = -d.x * d.y, c = 1 - d.y * d.y;
      xx += a, xy += b, yy += c;
      right += dvec2(a * one.point.x + b * one.point.y, b * one.point.x + c * one.point.y);
    }
    const double det = xx * yy - xy * xy;
    const dvec2 place = dvec2(yy * right.x - xy * right.y, xx * right.y - xy * right.x) / det;
    return glm::distance(place, middle) < std::max(reach, 3.0) ? place : middle;
  }

  std::vector<dvec2> straightened(std::size_t b) const {
    const Branch& branch = branches_[b];
    const dvec2 from = nodes_[branch.from].place, to = nodes_[branch.to].place;
    if (branch.from == branch.to && nodes_[branch.from].reach_m == 0) return branch.line;  // a ring
    const Arm first = arm(b, true), last = arm(b, false);
    std::vector<dvec2> line = {from, first.point};
    double s = 0;
    const double length = length_of(branch.line);
    for (std::size_t n = 0; n < branch.line.size(); ++n) {
      if (n > 0) s += glm::distance(branch.line[n - 1], branch.line[n]);
      if (s > first.cut && s < length - last.cut) line.push_back(branch.line[n]);
    }
    line.push_back(last.point);
    line.push_back(to);
    return line;
  }

  std::vector<Axis::Node> nodes_;
  std::vector<Branch> branches_;
  std::vector<double> widths_;  // of the branches
};

}  // namespace

std::vector<Centreline> find_centrelines(Axis&& axis) {
  return Cleaner(std::move(axis)).run();
}

}  // namespace nightcity::streets
