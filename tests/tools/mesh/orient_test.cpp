#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "tools/mesh/boxes.h"
#include "tools/mesh/mesh_report.h"
#include "tools/mesh/orient.h"
#include "tools/mesh/polygon_plane.h"

namespace nightcity::mesh {
namespace {

using namespace test;

void turn(city::Polygon& polygon) {
  std::reverse(polygon.exterior.begin(), polygon.exterior.end());
  for (city::Ring& ring : polygon.interiors) std::reverse(ring.begin(), ring.end());
}

std::size_t oriented(city::CityObject& object) {
  MeshReport report;
  orient_outward(object, report);
  return report.turned;
}

TEST(Orient, AnyFacesOfABoxTurnedInwardAreTurnedBack) {
  for (unsigned mask = 0; mask < 64; ++mask) {
    city::CityObject object = building(box(32500000, 5800000, 30, 10));
    std::size_t turned = 0;
    for (unsigned i = 0; i < 6; ++i) {
      if ((mask >> i & 1) == 0) continue;
      turn(object.polygons[i]);
      ++turned;
    }
    EXPECT_EQ(oriented(object), turned);
    EXPECT_NEAR(volume(object), 1000, 1e-6);
  }
}

TEST(Orient, OpenBoxIsLeftAlone) {
  std::vector<city::Polygon> faces = box(0, 0, 0, 10);
  faces.pop_back();
  turn(faces[2]);
  city::CityObject object = building(faces);
  EXPECT_EQ(oriented(object), 0u);
  EXPECT_EQ(object.polygons[2].exterior, faces[2].exterior);
}

TEST(Orient, RoofsAndFloorsOfAnOpenShellSayWhichWayIsOut) {
  std::vector<city::Polygon> faces = box(32500000, 5800000, 30, 10);
  std::size_t last_wall = 0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const double up = city::area_vector(faces[i].exterior).z;
    faces[i].surface = up > 1    ? city::SurfaceType::roof
                       : up < -1 ? city::SurfaceType::ground
                                 : city::SurfaceType::wall;
    if (faces[i].surface == city::SurfaceType::wall) last_wall = i;
  }
  faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(last_wall));  // an open garage
  for (unsigned mask = 0; mask < 32; ++mask) {
    city::CityObject object = building(faces);
    for (unsigned i = 0; i < 5; ++i)
      if (mask >> i & 1) turn(object.polygons[i]);
    const bool all = mask == 31;
    const city::CityObject before = object;
    EXPECT_EQ(oriented(object), all ? 5u : 0u) << "nothing is guessed where polygons disagree";
    for (std::size_t i = 0; i < faces.size(); ++i)
      EXPECT_EQ(city::area_vector(object.polygons[i].exterior),
                city::area_vector((all ? faces : before.polygons)[i].exterior))
          << mask << " " << i;
  }
  for (city::Polygon& face : faces) {
    turn(face);
    if (face.surface == city::SurfaceType::ground) face.surface = city::SurfaceType::wall;
  }
  city::CityObject floorless = building(faces);
  EXPECT_EQ(oriented(floorless), 0u) << "a roof alone may be the lower side of eaves";
}

TEST(Orient, WallWithAWindowInItsHoleIsOneShell) {
  std::vector<city::Polygon> faces = box(0, 0, 0, 10);
  const city::Ring window{{3, 0, 3}, {6, 0, 3}, {6, 0, 6}, {3, 0, 6}};
  faces[2].interiors = {city::Ring(window.rbegin(), window.rend())};
  city::Polygon pane;
  pane.exterior = window;
  pane.surface = city::SurfaceType::window;
  faces.push_back(pane);
  for (const std::size_t inward : {std::size_t{2}, std::size_t{6}}) {
    city::CityObject object = building(faces);
    turn(object.polygons[inward]);
    EXPECT_EQ(oriented(object), 1u);
    EXPECT_NEAR(volume(object), 1000, 1e-9);
  }
}

TEST(Orient, PartsThatShareAWallAreTurnedOutwardRoundBoth) {
  std::vector<city::Polygon> faces = box(0, 0, 0, 10);
  for (city::Polygon& p : box(10, 0, 0, 10)) faces.push_back(p);
  const city::CityObject right = building(faces);
  for (std::size_t i = 6; i < 12; ++i) turn(faces[i]);
  turn(faces[1]);
  city::CityObject object = building(faces);
  EXPECT_EQ(oriented(object), 6u);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (i == 3 || i == 11) continue;  // the wall between them, from each side: no camera sees it
    EXPECT_GT(glm::dot(city::area_vector(object.polygons[i].exterior),
                       city::area_vector(right.polygons[i].exterior)),
              0)
        << i;
  }
}

TEST(Orient, CavityKeepsFacingIntoItself) {
  std::vector<city::Polygon> faces = box(0, 0, 0, 10);
  for (city::Polygon& p : box(4, 4, 4, 2)) {
    turn(p);
    faces.push_back(p);
  }
  city::CityObject object = building(faces);
  EXPECT_EQ(oriented(object), 0u);
  EXPECT_NEAR(volume(object), 1000 - 8, 1e-9);
}

TEST(Orient, VerticesAMillimetreApartAreOne) {
  std::vector<city::Polygon> faces = box(0, 0, 0, 10);
  for (glm::dvec3& p : faces[3].exterior) p.x += 0.0003;
  turn(faces[3]);
  city::CityObject object = building(faces);
  EXPECT_EQ(oriented(object), 1u);
}

TEST(Orient, TerrainAndBrokenCoordinatesAreLeftAlone) {
  city::CityObject relief = building(box(0, 0, 0, 10));
  relief.type = city::ObjectType::relief;
  for (city::Polygon& p : relief.polygons) turn(p);
  EXPECT_EQ(oriented(relief), 0u);
  city::CityObject broken = building(box(0, 0, 0, 10));
  for (city::Polygon& p : broken.polygons) turn(p);
  broken.polygons[0].exterior[0].x = 1e300;
  EXPECT_EQ(oriented(broken), 0u);
}

}  // namespace
}  // namespace nightcity::mesh
