#include "tools/traffic/overlaps.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <set>
#include <utility>

#include "formats/traffic_pose.h"

namespace nightcity::traffic {
namespace {

struct Body {
  std::size_t trip;
  glm::dvec2 middle, forward;  // model x, z
  double height, half_length, half_width;
};

/// Returns whether two boxes overlap in plan (separating axis theorem) and neither lies
/// above the other.
bool overlap(const Body& a, const Body& b) {
  if (std::abs(a.height - b.height) > 2.5) return false;
  const glm::dvec2 apart = b.middle - a.middle;
  const auto reach = [](const Body& body, const glm::dvec2& axis) {
    const glm::dvec2 side(-body.forward.y, body.forward.x);
    return body.half_length * std::abs(glm::dot(body.forward, axis)) +
           body.half_width * std::abs(glm::dot(side, axis));
  };
  for (const Body* body : {&a, &b})
    for (const glm::dvec2& axis : {body->forward, glm::dvec2(-body->forward.y, body->forward.x)})
      if (std::abs(glm::dot(apart, axis)) >= reach(a, axis) + reach(b, axis)) return false;
  return true;
}

constexpr double longest_body_m = 14;  // no shorter than the longest body

/// The overlaps found in a stretch of the cycle.
struct Found {
  std::size_t samples = 0, overlapping = 0;
  std::set<std::pair<std::size_t, std::size_t>> pairs;
};

class Stretch {
 public:
  Stretch(const TrafficContent& traffic, double slack_m, Found& found)
      : traffic_(traffic),
        cycle_(double{traffic.cycle.cycle_s}),
        slack_m_(slack_m),
        found_(found) {}

  void begin(double t) {
    for (std::size_t n = 0; n < traffic_.trips.size(); ++n)
      if (on_drive(n, t)) driving_.push_back(n);
  }

  void add(std::span<const std::size_t> starting) {
    driving_.insert(driving_.end(), starting.begin(), starting.end());
  }

  void look(double t) {
    bodies_.clear();
    std::erase_if(driving_, [&](std::size_t n) {
      const auto u = on_drive(n, t);
      if (!u) return true;
      const Trip& trip = traffic_.trips[n];
      const VehiclePose pose = pose_on_trip(knots_of(trip), *u);
      const glm::vec3 half = traffic_.vehicles[trip.vehicle].half_size;
      bodies_.push_back({n,
                         {pose.position.x, pose.position.z},
                         {std::cos(pose.yaw), -std::sin(pose.yaw)},
                         pose.position.y,
                         double{half.x} - slack_m_,
                         double{half.z} - slack_m_});
      return false;
    });
    found_.samples += bodies_.size();
    // Sort from west to east, so that neighbours in x are neighbours in the list.
    std::sort(bodies_.begin(), bodies_.end(), [](const Body& a, const Body& b) {
      return a.middle.x != b.middle.x ? a.middle.x < b.middle.x : a.trip < b.trip;
    });
    hit_.assign(bodies_.size(), false);
    for (std::size_t a = 0; a < bodies_.size(); ++a)
      for (std::size_t b = a + 1; b < bodies_.size(); ++b) {
        if (bodies_[b].middle.x - bodies_[a].middle.x > longest_body_m) break;
        if (std::abs(bodies_[b].middle.y - bodies_[a].middle.y) > longest_body_m) continue;
        if (!overlap(bodies_[a], bodies_[b])) continue;
        hit_[a] = hit_[b] = true;
        found_.pairs.insert(std::minmax(bodies_[a].trip, bodies_[b].trip));
      }
    found_.overlapping += static_cast<std::size_t>(std::count(hit_.begin(), hit_.end(), true));
  }

 private:
  std::span<const TripKnot> knots_of(const Trip& trip) const {
    return traffic_.knots.subspan(trip.first_knot, trip.knot_count);
  }

  /// Returns the seconds since the start of a trip that is on the road at `t`.
  std::optional<double> on_drive(std::size_t n, double t) const {
    const Trip& trip = traffic_.trips[n];
    double u = t - double{trip.start_s};
    if (u < 0) u += cycle_;
    if (u >= double{knots_of(trip).back().time_s}) return std::nullopt;
    return u;
  }

  const TrafficContent& traffic_;
  double cycle_, slack_m_;
  Found& found_;
  std::vector<std::size_t> driving_;
  std::vector<Body> bodies_;
  std::vector<bool> hit_;
};

}  // namespace

OverlapReport find_overlaps(const TrafficContent& traffic, double step_s, double slack_m) {
  OverlapReport report;
  report.leave_out.assign(traffic.trips.size(), false);
  const double cycle = double{traffic.cycle.cycle_s};
  const auto steps = static_cast<std::size_t>(std::ceil(cycle / step_s));
  const auto moment = [&](std::size_t step) {
    return cycle * static_cast<double>(step) / static_cast<double>(steps);
  };
  // Sort trips by their start, so that each moment checks only the trips on the road.
  std::vector<std::vector<std::size_t>> starting(steps);
  for (std::size_t n = 0; n < traffic.trips.size(); ++n) {
    const auto at = static_cast<std::size_t>(
        std::ceil(double{traffic.trips[n].start_s} / cycle * static_cast<double>(steps)));
    starting[at % steps].push_back(n);
  }
  // Stretches of the cycle are checked in parallel; their results are merged in order.
  constexpr std::size_t stretch_steps = 64;
  std::vector<Found> found((steps + stretch_steps - 1) / stretch_steps);
  oneapi::tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t k) {
    Stretch stretch(traffic, slack_m, found[k]);
    const std::size_t first = k * stretch_steps;
    stretch.begin(moment(first));
    for (std::size_t step = first; step < std::min(first + stretch_steps, steps); ++step) {
      if (step > first) stretch.add(starting[step]);
      stretch.look(moment(step));
    }
  });
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (Found& one : found) {
    report.vehicle_samples += one.samples;
    report.overlapping += one.overlapping;
    pairs.merge(one.pairs);
  }
  // The trips with most overlaps are left out first, until no pair overlaps.
  std::vector<std::size_t> blame(traffic.trips.size(), 0);
  for (const auto& [a, b] : pairs) ++blame[a], ++blame[b];
  std::vector<std::pair<std::size_t, std::size_t>> left(pairs.begin(), pairs.end());
  std::stable_sort(left.begin(), left.end(), [&](const auto& p, const auto& q) {
    return std::max(blame[p.first], blame[p.second]) > std::max(blame[q.first], blame[q.second]);
  });
  for (const auto& [a, b] : left) {
    if (report.leave_out[a] || report.leave_out[b]) continue;
    report.leave_out[blame[a] > blame[b] ? a : b] = true;
    ++report.left_out;
  }
  return report;
}

}  // namespace nightcity::traffic
