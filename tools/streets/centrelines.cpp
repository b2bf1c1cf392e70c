#include "tools/streets/centrelines.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "tools/simplify_line.h"
#include "tools/streets/axis_cleaning.h"

namespace nightcity::streets {
namespace {

using glm::dvec2;
using Branch = Axis::Branch;

constexpr double straight_within_m = 0.4;  // deviation at which points of a line are removed

/// Returns the point at `s` along a line.
dvec2 place_on(const std::vector<dvec2>& line, double s) {
  for (std::size_t n = 1; n < line.size(); ++n) {
    const double step = glm::distance(line[n - 1], line[n]);
    if (s <= step && step > 0) return glm::mix(line[n - 1], line[n], std::max(s, 0.0) / step);
    s -= step;
  }
  return line.back();
}

/// Returns the median width of a branch: half of its length is no wider.
double find_median_width(const Branch& branch) {
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

class Straightener {
 public:
  explicit Straightener(Axis&& axis)
      : nodes_(std::move(axis.nodes)), branches_(std::move(axis.branches)) {
    for (const Branch& branch : branches_)
      widths_.push_back(std::min(find_median_width(branch), widest_street_m));
  }

  std::vector<Centreline> run() {
    find_places();
    std::vector<Centreline> result;
    for (std::size_t b = 0; b < branches_.size(); ++b) {
      Centreline street;
      street.from = branches_[b].from;
      street.to = branches_[b].to;
      street.width_m = widths_[b];
      street.line = simplify_line(straighten(b), straight_within_m);
      if (street.width_m > 0 && length_of(street.line) > 0.5) result.push_back(std::move(street));
    }
    return result;
  }

 private:
  /// The straight line on which a branch reaches the node at its start or end, where the junction
  /// does not yet bend the axis.
  struct Arm {
    dvec2 point, away;  // unit, from the node
    double cut;         // along the branch, to `point`
  };
  Arm find_arm(std::size_t b, bool at_start) const {
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
    const BranchesAt at = list_branches_at(nodes_.size(), branches_);
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (at[n].empty()) continue;
      Axis::Node& node = nodes_[n];
      std::vector<Arm> arms;
      for (std::size_t k = 0; k < at[n].size(); ++k) {
        const Branch& branch = branches_[at[n][k]];
        const bool ring = branch.from == branch.to;  // its two ends follow each other
        arms.push_back(
            find_arm(at[n][k], ring ? k == 0 || at[n][k - 1] != at[n][k] : branch.from == n));
      }
      if (at[n].size() == 1) {
        double beyond = 0;
        for (const dvec2& tip : node.tips)
          beyond = std::max(beyond, glm::dot(tip - arms[0].point, -arms[0].away));
        node.place = arms[0].point -
                     arms[0].away * std::clamp(beyond, 0.0, arms[0].cut + widest_street_m / 2);
      } else if (at[n].size() > 2) {
        node.place = find_meeting(arms, node.place, node.reach_m);
      }
    }
  }

  static dvec2 find_meeting(const std::vector<Arm>& arms, const dvec2& middle, double reach) {
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

  std::vector<dvec2> straighten(std::size_t b) const {
    const Branch& branch = branches_[b];
    const dvec2 from = nodes_[branch.from].place, to = nodes_[branch.to].place;
    if (branch.from == branch.to && nodes_[branch.from].reach_m == 0) return branch.line;  // a ring
    const Arm first = find_arm(b, true), last = find_arm(b, false);
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
  return Straightener(clean_axis(std::move(axis))).run();
}

}  // namespace nightcity::streets
