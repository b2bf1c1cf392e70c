#include "tools/streets/road_surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tools/streets/road_outline.h"

namespace nightcity::streets {
namespace {

city::Polygon polygon(city::SurfaceType surface, int function, double x = 0) {
  city::Polygon result;
  result.surface = surface;
  result.area_function = static_cast<std::uint16_t>(function);
  result.exterior = {{x, 0, 5}, {x + 8, 0, 5}, {x + 8, 4, 5}, {x, 4, 5}};
  return result;
}

city::CityObject road(std::vector<city::Polygon> polygons, const char* function = "") {
  city::CityObject object;
  object.type = city::ObjectType::road;
  object.function = function;
  object.polygons = std::move(polygons);
  return object;
}

TEST(RoadSurfaces, CarriagewaysAreTakenAndPavementsAreNot) {
  for (const int carriageway : {1, 1000, 1010, 1020})
    for (const int pavement : {2, 2000, 2020}) {
      RoadSurfaces roads;
      roads.add(road({polygon(city::SurfaceType::traffic_area, carriageway, 0),
                      polygon(city::SurfaceType::traffic_area, pavement, 20),
                      polygon(city::SurfaceType::auxiliary_traffic_area, 0, 40)}));
      ASSERT_EQ(roads.surfaces().size(), 1u);
      EXPECT_EQ(roads.surfaces()[0].exterior[0].x, 0);
      EXPECT_TRUE(roads.surfaces()[0].carriageway);
      EXPECT_EQ(roads.left_out().at("for others than vehicles"), 2u);
    }
}

TEST(RoadSurfaces, ARoadWithoutAreasIsTakenWhole) {
  RoadSurfaces roads;
  roads.add(road({polygon(city::SurfaceType::unknown, 0)}, "3"));
  ASSERT_EQ(roads.surfaces().size(), 1u);
  EXPECT_FALSE(roads.surfaces()[0].carriageway);
  EXPECT_STREQ(roads.surfaces()[0].highway, "secondary");
}

TEST(RoadSurfaces, APathForPedestriansHasNoSurface) {
  RoadSurfaces roads;
  roads.add(road({polygon(city::SurfaceType::traffic_area, 2)}));
  EXPECT_TRUE(roads.surfaces().empty());
}

TEST(RoadSurfaces, UprightBrokenAndForeignPolygonsAreNotTaken) {
  RoadSurfaces roads;
  city::Polygon kerb = polygon(city::SurfaceType::traffic_area, 1), broken = kerb;
  kerb.exterior = {{0, 0, 0}, {9, 0, 0}, {9, 0, 1}, {0, 0, 1}};
  broken.exterior[1].x = std::numeric_limits<double>::quiet_NaN();
  roads.add(road({kerb, broken}));
  city::CityObject building = road({polygon(city::SurfaceType::unknown, 0)});
  building.type = city::ObjectType::building;
  roads.add(building);
  EXPECT_TRUE(roads.surfaces().empty());
  EXPECT_EQ(roads.left_out().at("upright or without area"), 2u);
}

TEST(RoadSurfaces, MotorwaysAreLeftOutBecausePlansDoNotTellPiersFromGround) {
  RoadSurfaces roads;
  roads.add(road({polygon(city::SurfaceType::unknown, 0)}, "1"));
  EXPECT_TRUE(roads.surfaces().empty());
  EXPECT_EQ(roads.left_out().at("of motorways"), 1u);
}

TEST(RoadSurfaces, CodesTellTheClass) {
  EXPECT_STREQ(highway_of("2"), "primary");
  EXPECT_STREQ(highway_of("1040"), "tertiary");
  EXPECT_STREQ(highway_of("9020;3"), "secondary");
  EXPECT_EQ(highway_of("9020"), nullptr);
  EXPECT_EQ(highway_of("4"), nullptr);
  EXPECT_EQ(highway_of(""), nullptr);
  EXPECT_EQ(highway_of(";;"), nullptr);
}

// Roads that lie across each other at all angles: crossings rounded to doubles ended the program by
// a signal.
TEST(RoadOutline, SurfacesThatCrossAreOne) {
  std::mt19937 random(20);
  std::uniform_int_distribution<int> step(0, 6);
  for (int n = 0; n < 200; ++n) {
    std::vector<RoadSurface> surfaces(2 + random() % 8);
    for (RoadSurface& surface : surfaces)
      for (int k = 0; k < 10; ++k)
        surface.exterior.emplace_back(step(random) * 0.01, step(random) * 0.01);
    EXPECT_NO_THROW(road_outline(surfaces));
  }
}

TEST(RoadOutline, TheAreaOfAStarOfRoadsIsThatOfTheirUnion) {
  // Strips of 100 m by 10 m through one point, at a right angle and at odd ones, counted by
  // sampling.
  std::vector<RoadSurface> surfaces;
  const auto strip = [](double angle) {
    const glm::dvec2 along(std::cos(angle), std::sin(angle)), across(-along.y, along.x);
    return PlanRing{-50.0 * along - 5.0 * across, 50.0 * along - 5.0 * across,
                    50.0 * along + 5.0 * across, -50.0 * along + 5.0 * across};
  };
  const std::vector<double> angles{0.1, 0.1 + std::acos(0.0), 0.8, 2.3, 2.7};
  for (const double angle : angles) surfaces.push_back({strip(angle), {}, nullptr, true});
  double area = 0;
  for (const auto& [a, b] : road_outline(surfaces)) area += (a.x * b.y - a.y * b.x) / 2;
  const auto covered = [&](const glm::dvec2& p) {
    return std::any_of(angles.begin(), angles.end(), [&](double angle) {
      const glm::dvec2 along(std::cos(angle), std::sin(angle));
      return std::abs(p.x * along.x + p.y * along.y) < 50 &&
             std::abs(p.y * along.x - p.x * along.y) < 5;
    });
  };
  double expected = 0;
  constexpr double step = 0.1;
  for (double x = -60; x < 60; x += step)
    for (double y = -60; y < 60; y += step) expected += covered({x, y}) ? step * step : 0;
  EXPECT_NEAR(std::abs(area), expected, 0.01 * expected);
}

}  // namespace
}  // namespace nightcity::streets
