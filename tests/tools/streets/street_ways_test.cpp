#include "tools/streets/street_ways.h"

#include <gtest/gtest.h>

#include "formats/error.h"
#include "tools/streets/road_shapes.h"
#include "tools/traffic/road_graph.h"

namespace nightcity::streets {
namespace {

using glm::dvec2;

city::CityObject road(const PlanRing& ring, const char* function, std::uint16_t area) {
  city::CityObject object;
  object.type = city::ObjectType::road;
  object.function = function;
  city::Polygon polygon;
  polygon.surface = area ? city::SurfaceType::traffic_area : city::SurfaceType::unknown;
  polygon.area_function = area;
  for (const dvec2& p : ring) polygon.exterior.emplace_back(p, 3.0);
  object.polygons.push_back(polygon);
  return object;
}

constexpr double degrees = 1e-5;
dvec2 to_lon_lat(const dvec2& p) {
  return p * degrees;
}

TEST(StreetWays, RoadsThatCrossWithoutEndAreRefusedAndTheLimitNamed) {
  // A mat of 40 strips across 40 others: 6,400 crossings of 320 points.
  RoadSurfaces roads;
  for (int n = 0; n < 40; ++n) {
    roads.add(road(test::strip({0, 20.0 * n}, {800, 20.0 * n}, 6).exterior, "", 1));
    roads.add(road(test::strip({20.0 * n, 0}, {20.0 * n, 800}, 6).exterior, "", 1));
  }
  try {
    find_street_ways(roads, to_lon_lat);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("[city] max_crossings"), std::string::npos);
  }
  EXPECT_FALSE(find_street_ways(roads, to_lon_lat, 100).ways.empty());
}

TEST(StreetWays, ClassByCodeElseByWidth) {
  RoadSurfaces roads;
  roads.add(road(test::strip({0, 0}, {100, 0}, 6).exterior, "2", 1));
  roads.add(road(test::strip({0, 100}, {100, 100}, 6).exterior, "", 1));
  roads.add(road(test::strip({0, 200}, {100, 200}, 14).exterior, "9020", 0));
  const StreetWays streets = find_street_ways(roads, to_lon_lat);
  ASSERT_EQ(streets.ways.size(), 3u);
  std::map<int, osm::OsmTags> by_place;
  for (const osm::OsmWay& way : streets.ways)
    by_place[static_cast<int>(std::lround(way.lon_lat[0].y / degrees / 100))] = way.tags;
  EXPECT_EQ(by_place.at(0).at("highway"), "primary");
  EXPECT_EQ(by_place.at(0).at("width"), "6.0");
  EXPECT_EQ(by_place.at(1).at("highway"), "residential");
  // A whole street of 14 m: two pavements of 2 m leave 10 m.
  EXPECT_EQ(by_place.at(2).at("highway"), "secondary");
  EXPECT_EQ(by_place.at(2).at("width"), "10.0");
  EXPECT_NEAR(streets.km_by_code, 0.1, 0.001);
}

TEST(StreetWays, MakeAGraphToDriveOn) {
  RoadSurfaces roads;
  roads.add(road(test::strip({0, 50}, {200, 50}, 7).exterior, "3", 1));
  roads.add(road(test::strip({90, 0}, {90, 150}, 5).exterior, "", 1));
  const StreetWays streets = find_street_ways(roads, to_lon_lat);
  EXPECT_EQ(streets.junctions, 1u);
  EXPECT_EQ(streets.ends, 4u);
  const auto graph = traffic::make_road_graph(
      streets.ways, [](const dvec2& p) { return p / degrees; },
      [](const dvec2&) { return std::optional(0.0); }, {});
  EXPECT_EQ(graph.nodes.size(), 5u);
  EXPECT_EQ(graph.edges.size(), 8u);  // four streets, both directions
  EXPECT_NEAR(graph.lane_km(), 2 * 0.35, 0.01);
}

TEST(StreetWays, NoRoadsNoWays) {
  EXPECT_TRUE(find_street_ways({}, to_lon_lat).ways.empty());
}

}  // namespace
}  // namespace nightcity::streets
