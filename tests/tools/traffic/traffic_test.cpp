// Properties of the traffic as a renderer plays it back.
#include "tools/traffic/traffic.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numbers>

#include "formats/night_check.h"
#include "formats/traffic_pose.h"
#include "tools/traffic/street_grid.h"

namespace nightcity::traffic {
namespace {

using std::numbers::pi;

constexpr double tail_m = 60, size_m = 90;
constexpr int blocks = 4;
const Georeference origin{"", {150, 150, 40}, {}, {}};

const TrafficSet& town() {
  static const TrafficSet set = [] {
    TrafficOptions options;
    options.vehicles = 20;  // at 22 h
    options.cycle_s = 300;
    return make_traffic(test::street_grid(blocks, size_m, tail_m), test::to_plane, test::hills, {},
                        options, origin);
  }();
  return set;
}

/// A cycle with every trip on the road.
TrafficContent busiest() {
  TrafficContent content = town().content();
  for (float& share : content.cycle.density) share = 1;
  return content;
}

std::span<const TripKnot> knots_of(const TrafficContent& content, const Trip& trip) {
  return content.knots.subspan(trip.first_knot, trip.knot_count);
}

TEST(Traffic, IsFitForAFile) {
  const TrafficContent content = town().content();
  ASSERT_GT(content.trips.size(), 50u);
  EXPECT_FALSE(cycle_fault(content.cycle));
  for (const VehicleKind& kind : content.vehicles)
    EXPECT_FALSE(vehicle_fault(kind, content.vehicle_lights.size()));
  for (const Light& light : content.vehicle_lights)
    EXPECT_FALSE(vehicle_light_fault(light, town().profiles.profiles.size()));
  for (const Trip& trip : content.trips)
    EXPECT_FALSE(trip_fault(trip, content.cycle, content.vehicles.size(), content.knots));
}

TEST(Traffic, PlaceSpeedAndHeadingAreContinuousOverTheWholeCycle) {
  const TrafficContent content = busiest();
  constexpr double step = 1.0 / 32;
  for (const Trip& trip : content.trips) {
    const auto knots = knots_of(content, trip);
    VehiclePose last = pose_on_trip(knots, 0);
    for (double u = step; u <= double{knots.back().time_s}; u += step) {
      const VehiclePose pose = pose_on_trip(knots, u);
      const double speed = std::max(glm::length(pose.velocity), glm::length(last.velocity));
      ASSERT_LE(glm::distance(pose.position, last.position), speed * step * 1.2 + 0.005);
      ASSERT_LE(glm::distance(pose.velocity, last.velocity), 12 * step + 0.25);
      // No vehicle turns in a tighter circle than 2 m.
      ASSERT_LE(std::abs(std::remainder(pose.yaw - last.yaw, 2 * pi)), speed * step / 2 + 0.01);
      last = pose;
    }
  }
}

TEST(Traffic, GoesOnOverTheWrapOfTheCycle) {
  const TrafficContent content = busiest();
  const double cycle = double{content.cycle.cycle_s};
  std::size_t over = 0;
  for (const Trip& trip : content.trips) {
    if (double{trip.start_s} + double{knots_of(content, trip).back().time_s} <= cycle + 0.1)
      continue;
    const auto before = pose_at(content, trip, 5 * cycle - 1e-3),
               after = pose_at(content, trip, 5 * cycle + 1e-3);
    ASSERT_TRUE(before && after);
    EXPECT_LE(glm::distance(before->position, after->position), 0.05);
    ++over;
  }
  EXPECT_GT(over, 10u);
}

TEST(Traffic, HeadsWhereItDrives) {
  const TrafficContent content = busiest();
  for (const Trip& trip : content.trips)
    for (double t = 0; t < 300; t += 1.7) {
      const auto pose = pose_at(content, trip, t);
      const double speed = pose ? std::hypot(pose->velocity.x, pose->velocity.z) : 0;
      if (speed < 2) continue;
      const double course = std::atan2(-pose->velocity.z, pose->velocity.x);
      ASSERT_LE(std::abs(std::remainder(course - pose->yaw, 2 * pi)), 4 * pi / 180)
          << "speed " << speed;
      ASSERT_NEAR(pose->pitch, std::atan2(pose->velocity.y, speed), 0.03);
    }
}

TEST(Traffic, WheelsStandOnASlopeAtTheKerbToo) {
  const auto find_height = [](const glm::dvec2& p) { return 0.15 * p.x + 0.1 * p.y; };
  TrafficOptions options;
  options.vehicles = 20;
  options.cycle_s = 300;
  const TrafficSet set = make_traffic(
      test::street_grid(blocks, size_m, tail_m), test::to_plane,
      [&](const glm::dvec2& p) { return std::optional(find_height(p)); }, {}, options, {});
  const TrafficContent content = set.content();
  std::size_t parked = 0;
  for (const Trip& trip : content.trips)
    for (const TripKnot& knot : knots_of(content, trip)) {
      EXPECT_NEAR(knot.position.y, find_height({knot.position.x, -knot.position.z}), 0.05);
      parked += knot.time_s == 0 && glm::length(knot.velocity) < 0.1f;
    }
  EXPECT_GT(parked, 5u);
}

TEST(Traffic, WheelsStandOnASlopeUpToTheEdgeOfTheGround) {
  const place::HeightAt part = [](const glm::dvec2& p) {
    const double along = 0.96 * p.x + 0.28 * p.y;  // the edge runs aslant
    return std::abs(along) < 300 ? std::optional(0.3 * p.x) : std::nullopt;
  };
  TrafficOptions options;
  options.vehicles = 20;
  options.cycle_s = 300;
  const TrafficSet set =
      make_traffic({test::street(1, {{-900, 0}, {900, 0}}, {{"highway", "secondary"}})},
                   test::to_plane, part, {}, options, {});
  std::size_t at_edge = 0;
  for (const TripKnot& knot : set.content().knots) {
    EXPECT_NEAR(knot.position.y, 0.3 * knot.position.x, 0.1);
    at_edge += std::abs(knot.position.x) > 308;
  }
  EXPECT_GT(at_edge, 5u);
}

TEST(Traffic, AppearsAndVanishesAtEndsOfStreetsAndAtKerbsOnly) {
  const TrafficContent content = busiest();
  const double low = -tail_m, high = blocks * size_m + tail_m;
  for (const Trip& trip : content.trips) {
    const auto knots = knots_of(content, trip);
    for (const TripKnot* end : {&knots.front(), &knots.back()}) {
      const glm::dvec3 p = origin.from_model(glm::dvec3(end->position));
      const double to_end = std::min({p.x - low, p.y - low, high - p.x, high - p.y});
      const double speed = glm::length(glm::dvec3(end->velocity));
      EXPECT_TRUE(speed < 0.4 || to_end < 8) << "at " << p.x << ", " << p.y << " with " << speed;
    }
  }
}

TEST(Traffic, StandsOnTheGround) {
  const TrafficContent content = busiest();
  double worst = 0;
  for (const Trip& trip : content.trips)
    for (double t = 0; t < 300; t += 0.9)
      if (const auto pose = pose_at(content, trip, t)) {
        const glm::dvec3 p = origin.from_model(pose->position);
        worst = std::max(worst, std::abs(p.z - *test::hills({p.x, p.y})));
      }
  EXPECT_LT(worst, 0.10);
}

TEST(Traffic, KeepsToItsSideOfTheStreet) {
  // Away from junctions, vehicles keep within the carriageway, and to the right of its middle
  // on two-way streets.
  const TrafficContent content = busiest();
  for (const Trip& trip : content.trips)
    for (double t = 0; t < 300; t += 1.1) {
      const auto pose = pose_at(content, trip, t);
      if (!pose) continue;
      const glm::dvec3 p = origin.from_model(pose->position);
      const auto from_line = [&](double x) {
        return x - size_m * std::round(std::clamp(x / size_m, 0.0, 1.0 * blocks));
      };
      const double dx = from_line(p.x), dy = from_line(p.y);
      const bool along_x = std::abs(dy) < std::abs(dx);
      if (std::abs(along_x ? dx : dy) < 16) continue;
      const double east = std::cos(pose->yaw), north = std::sin(pose->yaw);
      const double to_right = along_x ? -dy * (east > 0 ? 1 : -1) : dx * (north > 0 ? 1 : -1);
      const int line = static_cast<int>(
          std::lround(std::clamp((along_x ? p.y : p.x) / size_m, 0.0, 1.0 * blocks)));
      const double half_width = line == blocks / 2 ? 3.25 : 2.75;
      const double half_body = double{content.vehicles[trip.vehicle].half_size.z};
      ASSERT_LE(std::abs(to_right) + half_body, half_width + 0.15) << "at " << p.x << ", " << p.y;
      const bool one_way = line % 3 == 2 && line != blocks / 2;
      if (!one_way && line % 3 != 2) {
        ASSERT_GE(to_right - half_body, -0.1) << "at " << p.x << ", " << p.y;
      }
    }
}

TEST(Traffic, NoTwoBodiesOverlapAtAnyHour) {
  const TrafficContent content = busiest();
  const OverlapReport report = find_overlaps(content, 0.5, 0.08);
  EXPECT_GT(report.vehicle_samples, 5000u);
  EXPECT_EQ(report.overlapping, 0u);
  EXPECT_LT(town().report.overlaps_left_out, content.trips.size() / 20);
}

TEST(Traffic, IsWithinTheToleranceItStates) {
  const TrafficReport& report = town().report;
  EXPECT_LE(report.knot_error.position_m, report.tolerance.position_m + 1e-3);
  EXPECT_LE(report.knot_error.heading_degrees, report.tolerance.heading_degrees + 0.5);
}

TEST(Traffic, BrakesWhereItSlowsDown) {
  const TrafficContent content = busiest();
  std::size_t hard = 0, shown = 0;
  for (const Trip& trip : content.trips)
    for (double t = 0; t < 300; t += 0.6) {
      const auto now = pose_at(content, trip, t), next = pose_at(content, trip, t + 0.5);
      if (!now || !next) continue;
      if (glm::length(next->velocity) > glm::length(now->velocity) - 0.8) continue;
      ++hard;
      shown += now->braking || next->braking;
    }
  EXPECT_GT(hard, 100u);
  EXPECT_GE(static_cast<double>(shown), 0.98 * static_cast<double>(hard));
}

TEST(Traffic, SharesOfTheHoursAreOnTheRoad) {
  const TrafficContent content = town().content();
  const auto on_road = [&](double hour) {
    double sum = 0;
    for (int k = 0; k < 60; ++k)
      for (const Trip& trip : content.trips)
        sum += pose_at(content, trip, hour * 3600 + k * 5.0).has_value();
    return sum / 60;
  };
  const double evening = on_road(5), late = on_road(10), night = on_road(15);
  EXPECT_NEAR(evening, town().report.mean_vehicles, 0.15 * evening);
  EXPECT_NEAR(late / evening, 0.69, 0.12);
  EXPECT_NEAR(night / evening, 0.12, 0.08);
  // As many as the options ask for at 22:00, apart from waiting times and trips that are left out.
  EXPECT_NEAR(late, 20, 5);
}

TEST(Traffic, AnotherSeedIsAnotherTrafficAndTheSameSeedTheSame) {
  const auto make = [](std::uint64_t seed) {
    TrafficOptions options;
    options.vehicles = 6;
    options.cycle_s = 120;
    options.seed = seed;
    return make_traffic(test::street_grid(2, size_m, tail_m), test::to_plane, test::plane, {},
                        options, origin);
  };
  const TrafficSet a = make(1), b = make(1), c = make(2);
  ASSERT_EQ(a.knots.size(), b.knots.size());
  EXPECT_TRUE(std::equal(
      a.knots.begin(), a.knots.end(), b.knots.begin(), [](const TripKnot& p, const TripKnot& q) {
        return p.position == q.position && p.pose == q.pose && p.time_s == q.time_s;
      }));
  ASSERT_FALSE(c.trips.empty());
  EXPECT_NE(a.trips.front().id, c.trips.front().id);
}

TEST(Traffic, IsTheSameOnOneThreadAndOnFour) {
  const auto make = [](int threads) {
    const oneapi::tbb::global_control allowed(oneapi::tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(threads));
    oneapi::tbb::task_arena arena(threads);
    return arena.execute([] {
      TrafficOptions options;
      options.vehicles = 40;  // enough that they wait for each other
      options.cycle_s = 180;
      return make_traffic(test::street_grid(3, size_m, tail_m), test::to_plane, test::hills, {},
                          options, origin);
    });
  };
  const TrafficSet one = make(1), four = make(4);
  ASSERT_GT(one.trips.size(), 50u);
  ASSERT_EQ(one.trips.size(), four.trips.size());
  ASSERT_EQ(one.knots.size(), four.knots.size());
  EXPECT_EQ(std::memcmp(one.trips.data(), four.trips.data(), one.trips.size() * sizeof(Trip)), 0);
  EXPECT_EQ(std::memcmp(one.knots.data(), four.knots.data(), one.knots.size() * sizeof(TripKnot)),
            0);
  EXPECT_EQ(one.report.simulation.steps, four.report.simulation.steps);
}

TEST(Traffic, NoStreetsNoTraffic) {
  const TrafficSet set = make_traffic({}, test::to_plane, test::plane, {}, {}, origin);
  EXPECT_TRUE(set.trips.empty());
  EXPECT_TRUE(set.vehicles.empty());
}

TEST(Traffic, HostileMapsAreSurvived) {
  std::vector<osm::OsmWay> ways;
  const osm::OsmTags tags = {
      {"highway", "primary"}, {"lanes", "12"}, {"width", "0.5"}, {"maxspeed", "3"}};
  ways.push_back({1, {}, tags});
  ways.push_back({2, {{0, 0}}, tags});
  ways.push_back({3, {{0, 0}, {0, 0}, {0, 0}}, tags});
  ways.push_back({4, {{NAN, 0}, {0, INFINITY}, {0, 0.001}}, tags});
  ways.push_back(test::street(5, {{0, 0}, {30, 0}, {0, 0}, {30, 0}, {60, 1}, {0, 0}}, tags));
  ways.push_back(test::street(6, {{0, 0}, {0.02, 0}, {0.04, 0}, {200, 3}}, tags));
  ways.push_back(test::street(7, {{30, 0}, {30, 400}, {30.01, 0}},
                              {{"highway", "residential"}, {"oneway", "-1"}}));
  TrafficOptions options;
  options.vehicles = 10;
  options.cycle_s = 120;
  const TrafficSet set = make_traffic(ways, test::to_plane, test::plane, {}, options, origin);
  for (const Trip& trip : set.trips)
    EXPECT_FALSE(trip_fault(trip, set.cycle, set.vehicles.size(), set.knots));
}

}  // namespace
}  // namespace nightcity::traffic
