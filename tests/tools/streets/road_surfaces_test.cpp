#include "tools/streets/road_surfaces.h"

#include <gtest/gtest.h>

#include <limits>

namespace nightcity::streets {
namespace {

Polygon polygon(SurfaceType surface, int function, double x = 0) {
  Polygon result;
  result.surface = surface;
  result.area_function = static_cast<std::uint16_t>(function);
  result.exterior = {{x, 0, 5}, {x + 8, 0, 5}, {x + 8, 4, 5}, {x, 4, 5}};
  return result;
}

CityObject road(std::vector<Polygon> polygons, const char* function = "") {
  CityObject object;
  object.type = ObjectType::road;
  object.function = function;
  object.polygons = std::move(polygons);
  return object;
}

TEST(RoadSurfaces, CarriagewaysAreTakenAndPavementsAreNot) {
  for (const int carriageway : {1, 1000, 1010, 1020})
    for (const int pavement : {2, 2000, 2020}) {
      RoadSurfaces roads;
      roads.add(road({polygon(SurfaceType::traffic_area, carriageway, 0),
                      polygon(SurfaceType::traffic_area, pavement, 20),
                      polygon(SurfaceType::auxiliary_traffic_area, 0, 40)}));
      ASSERT_EQ(roads.surfaces().size(), 1u);
      EXPECT_EQ(roads.surfaces()[0].exterior[0].x, 0);
      EXPECT_TRUE(roads.surfaces()[0].carriageway);
      EXPECT_EQ(roads.left_out().at("for others than vehicles"), 2u);
    }
}

TEST(RoadSurfaces, ARoadWithoutAreasIsTakenWhole) {
  RoadSurfaces roads;
  roads.add(road({polygon(SurfaceType::unknown, 0)}, "3"));
  ASSERT_EQ(roads.surfaces().size(), 1u);
  EXPECT_FALSE(roads.surfaces()[0].carriageway);
  EXPECT_STREQ(roads.surfaces()[0].highway, "secondary");
}

TEST(RoadSurfaces, APathForPedestriansHasNoSurface) {
  RoadSurfaces roads;
  roads.add(road({polygon(SurfaceType::traffic_area, 2)}));
  EXPECT_TRUE(roads.surfaces().empty());
}

TEST(RoadSurfaces, UprightBrokenAndForeignPolygonsAreNotTaken) {
  RoadSurfaces roads;
  Polygon kerb = polygon(SurfaceType::traffic_area, 1), broken = kerb;
  kerb.exterior = {{0, 0, 0}, {9, 0, 0}, {9, 0, 1}, {0, 0, 1}};
  broken.exterior[1].x = std::numeric_limits<double>::quiet_NaN();
  roads.add(road({kerb, broken}));
  CityObject building = road({polygon(SurfaceType::unknown, 0)});
  building.type = ObjectType::building;
  roads.add(building);
  EXPECT_TRUE(roads.surfaces().empty());
  EXPECT_EQ(roads.left_out().at("upright or without area"), 2u);
}

TEST(RoadSurfaces, MotorwaysAreLeftOutBecausePlansDoNotTellPiersFromGround) {
  RoadSurfaces roads;
  roads.add(road({polygon(SurfaceType::unknown, 0)}, "1"));
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

}  // namespace
}  // namespace nightcity::streets
