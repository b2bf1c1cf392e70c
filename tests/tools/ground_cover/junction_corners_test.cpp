#include "tools/ground_cover/junction_corners.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/tools/ground_cover/metre_map.h"
#include "tests/tools/ground_cover/plan_areas.h"

namespace nightcity::ground_cover {
namespace {

using std::numbers::pi;

glm::dvec2 find_direction(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

double find_area(const Ring& ring) {
  double area = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    area += (a.x * b.y - a.y * b.x) / 2;
  }
  return area;
}

TEST(JunctionCorners, TheArcTouchesBothEdgesAndHasItsRadius) {
  for (const double angle : {pi / 3, pi / 2, 2 * pi / 3}) {
    const glm::dvec2 junction(7, -3);
    const CornerArm first{find_direction(0.4), 60, 3}, second{find_direction(0.4 + angle), 60, 5};
    const auto ring = make_corner(junction, first, second, 4);
    ASSERT_TRUE(ring);
    // The arc's middle lies 4 m beyond both edges.
    const glm::dvec2 left(-first.along.y, first.along.x), right(second.along.y, -second.along.x);
    EXPECT_LT(glm::dot(ring->front() - junction, left), 3) << "within the first arm";
    EXPECT_LT(glm::dot(ring->front() - junction, right), 5) << "and the second";
    const glm::dvec2 p = (*ring)[1] - junction, q = ring->back() - junction;
    EXPECT_NEAR(glm::dot(p, left), 3, 1e-9);
    EXPECT_NEAR(glm::dot(q, right), 5, 1e-9);
    const glm::dvec2 middle = p + 4.0 * left;
    EXPECT_NEAR(glm::distance(middle, q + 4.0 * right), 0, 1e-9);
    for (std::size_t i = 1; i < ring->size(); ++i)
      EXPECT_NEAR(glm::distance((*ring)[i] - junction, middle), 4, 1e-9);
    EXPECT_GT(find_area(*ring), 0);
  }
}

TEST(JunctionCorners, AShortArmHasASmallerArcAndSomeHaveNone) {
  const CornerArm far{{1, 0}, 60, 3};
  const auto corner = [&](double degrees, double length_m) {
    return make_corner({0, 0}, far, {find_direction(degrees * pi / 180), length_m, 3}, 4);
  };
  const auto whole = corner(90, 60), less = corner(90, 5);
  ASSERT_TRUE(whole && less);
  EXPECT_NEAR(whole->back().y, 7, 1e-9);
  EXPECT_NEAR(less->back().y, 5, 1e-9) << "it ends with the arm";
  EXPECT_FALSE(corner(90, 3.4));
  EXPECT_FALSE(corner(40, 60)) << "an island";
  EXPECT_FALSE(corner(160, 60)) << "no corner";
  EXPECT_FALSE(corner(-90, 60)) << "on the other side";
}

Cover make_crossing(const char* highway, bool rounded) {
  const std::vector<osm::OsmWay> ways{way({{-100, 0}, {0, 0}, {100, 0}}, {{"highway", highway}}),
                                      way({{0, -100}, {0, 0}, {0, 100}}, {{"highway", highway}})};
  Cover cover;
  add_streets(ways, false, as_metres, bounds, cover);
  if (rounded) add_corners(ways, as_metres, bounds, cover);
  cover.finish();
  return cover;
}

TEST(JunctionCorners, ACrossingGainsFourCornersAndItsPavementsKeepTheirWidth) {
  const auto before = make_crossing("residential", false),
             after = make_crossing("residential", true);
  EXPECT_EQ(after.rounded_corners, 4u);
  const auto sharp = areas_of(before, middle), round = areas_of(after, middle);
  // A square of the radius less a quarter circle in chords, one for each metre of the radius.
  const auto corner_m2 = [](double radius_m) {
    const double chords = std::ceil(radius_m);
    return radius_m * radius_m * (1 - chords / 2 * std::sin(pi / 2 / chords));
  };
  EXPECT_NEAR(round.at("asphalt") - sharp.at("asphalt"), 4 * corner_m2(4), 0.1);
  EXPECT_NEAR(round.at("sunken"), round.at("asphalt"), 1e-9);
  EXPECT_NEAR(round.at("paving stones") - sharp.at("paving stones"),
              4 * (corner_m2(4 - 2.5) - corner_m2(4)), 0.1);
}

TEST(JunctionCorners, EntrancesAndBendsHaveNone) {
  EXPECT_EQ(make_crossing("service", true).rounded_corners, 0u);
  EXPECT_EQ(make_crossing("footway", true).rounded_corners, 0u);
  const std::vector<osm::OsmWay> bend{
      way({{-100, 0}, {0, 0}, {0, 100}}, {{"highway", "residential"}})};
  Cover cover;
  add_corners(bend, as_metres, bounds, cover);
  EXPECT_EQ(cover.rounded_corners, 0u);
}

}  // namespace
}  // namespace nightcity::ground_cover
