#include "tools/traffic/overlaps.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <unordered_map>
#include <utility>

#include "formats/traffic_pose.h"

namespace nightcity::traffic {
namespace {

struct Body {
  std::size_t trip;
  glm::dvec2 middle, forward;  // model x, z
  double height, half_length, half_width;
};

/// Oriented boxes in plan, by separating axes; and not one above the other.
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

constexpr double cell_m = 14;  // no shorter than the longest body, so that neighbours share or touch cells

std::uint64_t cell(double x, double z, int dx, int dz) {
  const auto i = static_cast<std::int64_t>(std::floor(x / cell_m)) + dx;
  const auto k = static_cast<std::int64_t>(std::floor(z / cell_m)) + dz;
  return static_cast<std::uint64_t>(i) << 32 ^ (static_cast<std::uint64_t>(k) & 0xFFFFFFFFu);
}

}  // namespace

OverlapReport find_overlaps(const TrafficContent& traffic, double step_s, double slack_m) {
  OverlapReport report;
  report.drop.assign(traffic.trips.size(), false);
  const double cycle = double{traffic.cycle.cycle_s};
  const auto steps = static_cast<std::size_t>(std::ceil(cycle / step_s));
  // Trips by the moment at which they start, so that a moment looks at those on the road only.
  std::vector<std::vector<std::size_t>> starting(steps);
  for (std::size_t n = 0; n < traffic.trips.size(); ++n) {
    const auto at = static_cast<std::size_t>(
        std::ceil(double{traffic.trips[n].start_s} / cycle * static_cast<double>(steps)));
    starting[at % steps].push_back(n);
  }
  std::vector<std::size_t> driving;
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  std::vector<Body> bodies;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells;
  for (std::size_t round = 0; round < 2 * steps; ++round) {  // the first cycle only fills the roads
    const std::size_t step = round % steps;
    const double t = cycle * static_cast<double>(step) / static_cast<double>(steps);
    driving.insert(driving.end(), starting[step].begin(), starting[step].end());
    bodies.clear();
    cells.clear();
    std::erase_if(driving, [&](std::size_t n) {
      const Trip& trip = traffic.trips[n];
      const auto knots = traffic.knots.subspan(trip.first_knot, trip.knot_count);
      double u = t - double{trip.start_s};
      if (u < 0) u += cycle;
      if (u >= double{knots.back().time_s}) return true;
      if (round < steps) return false;
      const VehiclePose pose = pose_on_drive(knots, u);
      const glm::vec3 half = traffic.vehicles[trip.vehicle].half_size;
      bodies.push_back({n,
                        {pose.position.x, pose.position.z},
                        {std::cos(pose.yaw), -std::sin(pose.yaw)},
                        pose.position.y,
                        double{half.x} - slack_m,
                        double{half.z} - slack_m});
      return false;
    });
    report.vehicle_samples += bodies.size();
    for (std::size_t n = 0; n < bodies.size(); ++n)
      cells[cell(bodies[n].middle.x, bodies[n].middle.y, 0, 0)].push_back(n);
    std::vector<bool> hit(bodies.size(), false);
    for (std::size_t n = 0; n < bodies.size(); ++n)
      for (int dx = -1; dx <= 1; ++dx)
        for (int dz = -1; dz <= 1; ++dz) {
          const auto found = cells.find(cell(bodies[n].middle.x, bodies[n].middle.y, dx, dz));
          if (found == cells.end()) continue;
          for (const std::size_t m : found->second) {
            if (m <= n || !overlap(bodies[n], bodies[m])) continue;
            hit[n] = hit[m] = true;
            pairs.insert(std::minmax(bodies[n].trip, bodies[m].trip));
          }
        }
    report.overlapping += static_cast<std::size_t>(std::count(hit.begin(), hit.end(), true));
  }
  // Those with most overlaps go first, until no pair is left whole.
  std::vector<std::size_t> blame(traffic.trips.size(), 0);
  for (const auto& [a, b] : pairs) ++blame[a], ++blame[b];
  std::vector<std::pair<std::size_t, std::size_t>> left(pairs.begin(), pairs.end());
  std::stable_sort(left.begin(), left.end(), [&](const auto& p, const auto& q) {
    return std::max(blame[p.first], blame[p.second]) > std::max(blame[q.first], blame[q.second]);
  });
  for (const auto& [a, b] : left) {
    if (report.drop[a] || report.drop[b]) continue;
    report.drop[blame[a] > blame[b] ? a : b] = true;
    ++report.dropped;
  }
  return report;
}

}  // namespace nightcity::traffic
