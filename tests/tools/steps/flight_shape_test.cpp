#include "tools/steps/flight_shape.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <map>

#include "tests/tools/steps/sloping_ground.h"

namespace nightcity::steps {
namespace {

glm::dvec3 area_vector(const Corners& c) {
  return glm::cross(c[1] - c[0], c[2] - c[0]) / 2.0;
}

// The areas of what looks up, and of the risers that look down the flight.
struct Areas {
  double treads_m2 = 0, risers_m2 = 0, down_m2 = 0;
};

Areas measure(const std::vector<Corners>& shape, const glm::dvec3& downhill) {
  Areas areas;
  for (const Corners& corners : shape) {
    const glm::dvec3 area = area_vector(corners);
    (area.z >= 0 ? areas.treads_m2 : areas.down_m2) += std::abs(area.z);
    if (std::abs(area.z) < 1e-12) areas.risers_m2 += std::max(0.0, glm::dot(area, downhill));
  }
  return areas;
}

TEST(FlightShape, TreadsFillThePlanAndRisersTheRise) {
  Flight flight{.width_m = 3, .line = {{0, 0}, {6, 0}}, .treads_m = {}, .ground_m = {}};
  for (int n = 1; n <= 12; ++n) {
    flight.treads_m.push_back(0.15 * n);
    flight.ground_m.push_back(0.15 * (n - 1));
  }
  const Areas areas = measure(make_shape(flight), {-1, 0, 0});
  EXPECT_NEAR(areas.treads_m2, 6 * 3, 1e-9);
  EXPECT_NEAR(areas.risers_m2, 3 * (12 * 0.15 + foot_m), 1e-9);
  EXPECT_EQ(areas.down_m2, 0);
}

TEST(FlightShape, RoundABendItHasNoGap) {
  // Twice 4 m with a right angle: the mitre adds and takes as much, so the plan is width x length.
  Flight flight{.width_m = 2, .line = {{0, 0}, {4, 0}, {4, 4}}, .treads_m = {}, .ground_m = {}};
  for (int n = 1; n <= 16; ++n) {
    flight.treads_m.push_back(0.15 * n);
    flight.ground_m.push_back(0);
  }
  const std::vector<Corners> shape = make_shape(flight);
  EXPECT_NEAR(measure(shape, {-1, 0, 0}).treads_m2, 2 * 8, 1e-9);
  EXPECT_EQ(measure(shape, {-1, 0, 0}).down_m2, 0);
  // All but the lower rim is closed: horizontally, what looks one way is what looks the other.
  glm::dvec3 sum(0);
  for (const Corners& corners : shape) sum += area_vector(corners);
  EXPECT_NEAR(sum.x, 0, 1e-9);
  EXPECT_NEAR(sum.y, 0, 1e-9);
}

TEST(FlightShape, OfNothingIsNothing) {
  EXPECT_TRUE(make_shape({}).empty());
}

}  // namespace
}  // namespace nightcity::steps
