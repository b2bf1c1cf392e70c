// Which way roofs run and fall.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/tools/map_buildings/roof_volume.h"
#include "tools/city/ring.h"

namespace nightcity::map_buildings {
namespace {

TEST(Roofs, TeethFallTheWayThatTheirTagSays) {
  const Outline hall{{{0, 0}, {24, 0}, {24, 10}, {0, 10}}, {}};
  const auto slopes = [&](double direction) {
    BuildingSizes s = sizes(RoofShape::sawtooth);
    s.direction_degrees = direction;
    bool flat = false;
    int count = 0;
    for (const city::Polygon& polygon : make_shell(hall, s, flat)) {
      const glm::dvec3 normal = glm::normalize(city::area_vector(polygon.exterior));
      if (polygon.surface != city::SurfaceType::roof || normal.z < 0.5) continue;
      const double angle = direction * std::numbers::pi / 180;
      EXPECT_GT(normal.x * std::sin(angle) + normal.y * std::cos(angle), 0.3);
      ++count;
    }
    return count;
  };
  EXPECT_EQ(slopes(90), 4) << "each of 6 m";
  EXPECT_EQ(slopes(270), 4);
  EXPECT_EQ(slopes(0), 2);
}

TEST(Roofs, TheLongSlopeOfASaltboxFallsTheWayItsTagSays) {
  for (const double degrees : {0.0, 90.0, 180.0, 270.0}) {
    BuildingSizes s = sizes(RoofShape::saltbox);
    s.direction_degrees = degrees;
    bool flat = false;
    double most = 0;
    glm::dvec3 largest{0};
    for (const city::Polygon& polygon : make_shell(rectangle, s, flat)) {
      if (polygon.surface != city::SurfaceType::roof) continue;
      const glm::dvec3 vector = city::area_vector(polygon.exterior);
      if (glm::length(vector) > most) most = glm::length(vector), largest = vector;
    }
    const double angle = degrees * std::numbers::pi / 180;
    EXPECT_NEAR(
        glm::dot(glm::normalize(glm::dvec2(largest)), glm::dvec2(std::sin(angle), std::cos(angle))),
        1, 1e-9);
  }
}

TEST(Roofs, AGableRunsAlongTheLongerSideUnlessAcross) {
  bool flat = false;
  BuildingSizes s = sizes(RoofShape::gabled);
  const auto top_at = [&](const std::vector<city::Polygon>& shell, const glm::dvec2& p) {
    double z = -1;
    for (const city::Polygon& polygon : shell)
      for (const glm::dvec3& v : polygon.exterior)
        if (glm::distance(glm::dvec2(v), p) < 1e-9) z = std::max(z, v.z);
    return z;
  };
  EXPECT_NEAR(top_at(make_shell(rectangle, s, flat), {0, 3}), 8, 1e-9);
  s.across = true;
  const auto across = make_shell(rectangle, s, flat);
  EXPECT_NEAR(top_at(across, {5, 0}), 8, 1e-9);
  EXPECT_EQ(top_at(across, {0, 3}), -1);
}

TEST(Roofs, ASkillionFallsTheWayItsTagSays) {
  for (const double degrees : {0.0, 90.0, 180.0, 270.0}) {
    BuildingSizes s = sizes(RoofShape::skillion);
    s.direction_degrees = degrees;
    bool flat = false;
    const glm::dvec2 fall(std::sin(degrees * std::numbers::pi / 180),
                          std::cos(degrees * std::numbers::pi / 180));
    for (const city::Polygon& polygon : make_shell(rectangle, s, flat)) {
      if (polygon.surface != city::SurfaceType::roof) continue;
      const glm::dvec3 normal = glm::normalize(city::area_vector(polygon.exterior));
      EXPECT_GT(normal.z, 0);
      EXPECT_GT(glm::dot(glm::dvec2(normal), fall), 0.1);
    }
  }
}

TEST(Roofs, ASkillionAcrossFallsAlongTheLongerSide) {
  const auto find_tops = [](std::optional<bool> across, std::optional<double> direction) {
    BuildingSizes s = sizes(RoofShape::skillion);
    s.across = across;
    s.direction_degrees = direction;
    bool flat = false;
    glm::dvec3 low(1e9), high(-1e9);
    for (const city::Polygon& polygon : make_shell(rectangle, s, flat))
      for (const glm::dvec3& p : polygon.exterior)
        if (p.z > 8 - 1e-9) low = glm::min(low, p), high = glm::max(high, p);
    return high - low;
  };
  EXPECT_NEAR(find_tops(true, {}).x, 0, 1e-9);
  EXPECT_NEAR(find_tops(true, {}).y, 6, 1e-9);
  EXPECT_NEAR(find_tops(false, {}).x, 10, 1e-9);
  EXPECT_NEAR(find_tops({}, {}).x, 10, 1e-9);
  EXPECT_NEAR(find_tops(true, 0).x, 10, 1e-9) << "roof:direction says more";
  BuildingSizes steep = sizes(RoofShape::skillion);
  steep.top_is_said = false;
  steep.across = true;
  steep.slope_degrees = 45;
  fit_slope(rectangle, steep);
  EXPECT_NEAR(steep.top_m - steep.eaves_m, 10, 1e-9);
}

}  // namespace
}  // namespace nightcity::map_buildings
