#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "tools/mesh/boxes.h"
#include "tools/mesh/close_gaps.h"
#include "tools/mesh/mesh_report.h"
#include "tools/mesh/polygon_plane.h"

namespace nightcity::mesh {
namespace {

using namespace test;

MeshReport repaired(city::CityObject& object) {
  MeshReport report;
  repair_shells(object, report);
  return report;
}

TEST(CloseGaps, AHouseWithoutItsGroundSurfaceGetsOneThatFacesDown) {
  city::CityObject object = building(box(391000, 5819000, 30, 10));
  object.polygons.erase(object.polygons.begin());  // the floor
  const MeshReport report = repaired(object);
  EXPECT_EQ(report.floors_added, 1u);
  EXPECT_EQ(report.first_repaired, "house");
  EXPECT_EQ(report.turned, 0u);
  EXPECT_EQ(report.open_objects, 0u);
  ASSERT_EQ(object.polygons.size(), 6u);
  EXPECT_EQ(object.polygons.back().surface, city::SurfaceType::ground);
  EXPECT_NEAR(city::area_vector(object.polygons.back().exterior).z, -100, 1e-6);
  EXPECT_NEAR(volume(object), 1000, 1e-6);
}

TEST(CloseGaps, AMissingWallOrRoofMayBeMeantAndStaysOpen) {
  for (std::size_t face = 1; face < 6; ++face) {
    city::CityObject object = building(box(0, 0, 0, 10));
    object.polygons.erase(object.polygons.begin() + static_cast<std::ptrdiff_t>(face));
    const MeshReport report = repaired(object);
    EXPECT_EQ(report.floors_added, 0u) << face;
    EXPECT_EQ(object.polygons.size(), 5u);
    EXPECT_EQ(report.open_objects, 1u);
  }
}

TEST(CloseGaps, CornersRoundedApartAreMovedTogetherAndTheShellIsThenTurned) {
  city::CityObject object = building(box(391000, 5819000, 30, 10));
  for (glm::dvec3& p : object.polygons[3].exterior) p += glm::dvec3(0.004, -0.003, 0.002);
  std::reverse(object.polygons[3].exterior.begin(), object.polygons[3].exterior.end());
  const MeshReport report = repaired(object);
  EXPECT_EQ(report.cracks_closed, 1u);
  EXPECT_EQ(report.turned, 1u);
  EXPECT_EQ(report.open_objects, 0u);
  EXPECT_NEAR(volume(object), 1000, 1.5);  // a wall of 100 m2 has moved by millimetres
}

TEST(CloseGaps, WiderGapsStayAsTheyAre) {
  city::CityObject object = building(box(0, 0, 0, 10));
  for (glm::dvec3& p : object.polygons[3].exterior) p.x += 0.02;
  const auto before = object.polygons[3].exterior;
  const MeshReport report = repaired(object);
  EXPECT_EQ(report.cracks_closed + report.floors_added, 0u);
  EXPECT_EQ(object.polygons[3].exterior, before);
}

TEST(CloseGaps, ALoneRoofAndATerrainAreLeftAlone) {
  city::CityObject canopy = building({box(0, 0, 0, 10)[1]});
  EXPECT_EQ(repaired(canopy).floors_added, 0u);
  city::CityObject relief = building(box(0, 0, 0, 10));
  relief.type = city::ObjectType::relief;
  relief.polygons.erase(relief.polygons.begin());
  EXPECT_EQ(repaired(relief).floors_added, 0u);
}

}  // namespace
}  // namespace nightcity::mesh
