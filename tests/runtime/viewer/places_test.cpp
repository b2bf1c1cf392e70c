// Places by coordinates and by the ids of city objects.
#include "runtime/viewer/places.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "formats/error.h"
#include "runtime/viewer/compass.h"
#include "support/scenes.h"

namespace nightcity::viewer {
namespace {

// A plane of 200 m around the Brandenburg Gate with a block 10 m high in the north-east.
scene::RenderScene make_scene() {
  scene::RenderScene scene =
      test::SceneBuilder().ground(100).box({20, 0, -40}, {30, 10, -20}).with({});
  scene.georeference.crs = "EPSG:25833";
  scene.georeference.origin = {389873, 5819611, 34};
  scene.features = {{"DEBE_01", "Building", "", {}, {}},
                    {"DEBE_02", "Road", "", {}, {}},
                    {"gate", "Building", "", {}, {}}};
  for (gpu::Triangle& triangle : scene.triangles.stored())
    triangle.feature = triangle.v0.y + triangle.v1.y + triangle.v2.y > 1 ? 2 : 1;
  return scene;
}

std::string error_of(const std::string& text, const scene::RenderScene& scene) {
  try {
    find_place(text, scene, MapProjection(scene.georeference.crs));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Places, LatitudeAndLongitudeArePlacesOfTheModel) {
  const MapProjection projection("EPSG:25833");
  const auto plane = projection.to_plane(52.516275, 13.377704);
  ASSERT_TRUE(plane);
  const auto back = projection.to_degrees(*plane);
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->x, 52.516275, 1e-8);
  EXPECT_NEAR(back->y, 13.377704, 1e-8);
  // On the central meridian, 15 degrees east, easting is 500,000 m; a minute of latitude is a
  // nautical mile within 1 %.
  const auto south = projection.to_plane(52, 15), north = projection.to_plane(52 + 1 / 60.0, 15);
  EXPECT_NEAR(south->x, 500'000, 1e-3);
  EXPECT_NEAR(north->y - south->y, 1852, 18);
}

// Tokyo Station in Japan's zone IX, as PROJ 9.1 projects it.
TEST(Places, OfJapansPlaneZonesAreWhereProjPutsThem) {
  const auto plane = MapProjection("EPSG:6677").to_plane(35.681236, 139.767125);
  ASSERT_TRUE(plane);
  EXPECT_NEAR(plane->x, -5992.9196, 0.01);
  EXPECT_NEAR(plane->y, -35363.2377, 0.01);
}

// The Brandenburg Gate and Sydney's opera house, by the same.
TEST(Places, OfUtmAreWhereProjPutsThem) {
  const auto gate = MapProjection("EPSG:25833").to_plane(52.516275, 13.377704);
  ASSERT_TRUE(gate);
  EXPECT_NEAR(gate->x, 389918.0415, 0.01);
  EXPECT_NEAR(gate->y, 5819699.1323, 0.01);
  const auto opera = MapProjection("EPSG:32756").to_plane(-33.8568, 151.2153);
  ASSERT_TRUE(opera);
  EXPECT_NEAR(opera->x, 334900.5697, 0.01);
  EXPECT_NEAR(opera->y, 6252288.7529, 0.01);
}

// A city that was given in degrees has a plane of its own, whose origin is in the city.
TEST(Places, OfACityGivenInDegreesAreMetresFromItsOrigin) {
  const MapProjection local(
      "+proj=tmerc +lat_0=52.5 +lon_0=13.4 +k=1 +x_0=0 +y_0=0 +a=6378137 +rf=298.257223563 "
      "+units=m +no_defs");
  const auto origin = local.to_plane(52.5, 13.4), north = local.to_plane(52.501, 13.4);
  ASSERT_TRUE(origin && north);
  EXPECT_NEAR(glm::length(*origin), 0, 1e-6);
  EXPECT_NEAR(north->y, 111.27, 0.02);  // a thousandth of a degree at this latitude
}

TEST(Places, OfUnknownGridsAndFarOffMeridiansAreNone) {
  EXPECT_FALSE(MapProjection("EPSG:28992").is_usable());
  EXPECT_FALSE(MapProjection("EPSG:32661").is_usable());
  EXPECT_FALSE(MapProjection("+proj=tmerc +lat_0=nan").is_usable());
  EXPECT_FALSE(MapProjection("EPSG:25833").to_plane(52, 120));
  EXPECT_FALSE(MapProjection("EPSG:25833").to_plane(std::nan(""), 15));
  EXPECT_FALSE(MapProjection("EPSG:25833").to_degrees({1e12, 0}));
}

TEST(Places, CoordinatesAreUnderstoodInTheWaysThatPeopleWriteThem) {
  const scene::RenderScene scene = make_scene();
  const MapProjection projection(scene.georeference.crs);
  const Place middle = find_place("389873 5819611", scene, projection);
  EXPECT_NEAR(glm::distance(middle.point, glm::vec3(0)), 0, 0.1);
  EXPECT_NEAR(find_place("389898, 5819641", scene, projection).point.y, 10, 0.01);  // on the block
  const auto degrees = projection.to_degrees({389873, 5819611});
  char text[80];
  std::snprintf(text, sizeof text, "%.7f, %.7f", degrees->x, degrees->y);
  EXPECT_NEAR(glm::distance(find_place(text, scene, projection).point, glm::vec3(0)), 0, 0.1);
  std::snprintf(text, sizeof text, " %.7f°N  %.7f E ", degrees->x, degrees->y);
  EXPECT_NEAR(glm::distance(find_place(text, scene, projection).point, glm::vec3(0)), 0, 0.1);
  std::snprintf(text, sizeof text, "%.7f E; %.7f N", degrees->y, degrees->x);
  EXPECT_NEAR(glm::distance(find_place(text, scene, projection).point, glm::vec3(0)), 0, 0.1);
}

TEST(Places, ObjectsAreFoundByTheirIdOrAPartOfIt) {
  const scene::RenderScene scene = make_scene();
  const MapProjection projection("");
  const Place gate = find_place("GATE", scene, projection);
  EXPECT_NEAR(glm::distance(gate.point, glm::vec3(25, 5, -30)), 0, 0.1);
  EXPECT_NEAR(gate.radius_m, glm::length(glm::vec3(5, 5, 10)), 0.1);
  // Two ids contain it; the first has no surfaces of its own.
  const Place road = find_place("debe", scene, projection);
  EXPECT_NE(road.name.find("DEBE_02"), std::string::npos) << road.name;
  EXPECT_NE(road.name.find("first of 2"), std::string::npos) << road.name;
}

TEST(Places, AnObjectThatIsAnInstanceIsFoundWhereItStands) {
  scene::RenderScene scene = make_scene();
  for (gpu::Instance& instance : scene.instances) instance.feature = 0;
  const Place all = find_place("DEBE_01", scene, MapProjection(""));
  EXPECT_GT(all.radius_m, glm::length(glm::vec3(5, 5, 10)) + 50) << "the ground and the block";
}

// A scene in a CRS that the runtime has no closed form of, with what its bake knew of it.
scene::RenderScene make_scene_with_places() {
  scene::RenderScene scene = make_scene();
  scene.georeference.crs = "EPSG:28992";
  const glm::dvec2 middle(scene.georeference.origin);
  scene.places.geographic = {
      middle - 1000.0, middle + 1000.0, 2, {52.37, 0.009, 0, 0}, {4.9, 0, 0.0147, 0}};
  scene.places.streets = {{"Lange Straße", {{{-80, 60}, {80, 60}}}},
                          {"Straßburger Platz", {{{0, 0}}}},
                          {"Gate Street", {{{-60, -80}, {-60, 80}}}}};
  return scene;
}

TEST(Places, LatitudeAndLongitudeFollowThePolynomialsOfTheFile) {
  const scene::RenderScene scene = make_scene_with_places();
  const MapProjection projection(scene.georeference.crs, scene.places.geographic);
  ASSERT_TRUE(projection.is_usable());
  // A tenth of the rectangle's half side, 1000 m, to the north.
  const Place north = find_place("52.3709, 4.9", scene, projection);
  EXPECT_NEAR(glm::distance(north.point, glm::vec3(0, 0, -100)), 0, 0.01);
  const auto degrees = projection.to_degrees(glm::dvec2(scene.georeference.origin) + 500.0);
  ASSERT_TRUE(degrees);
  EXPECT_NEAR(degrees->x, 52.3745, 1e-9);
  EXPECT_NEAR(degrees->y, 4.90735, 1e-9);
  try {
    find_place("53.37, 4.9", scene, projection);
    FAIL();
  } catch (const Error& error) {  // a degree of latitude is 111.2 km on a sphere
    EXPECT_NE(std::string(error.what()).find("111.2 km"), std::string::npos) << error.what();
  }
}

TEST(Places, StreetsAreFoundByTheirNameAndStoodOn) {
  const scene::RenderScene scene = make_scene_with_places();
  const MapProjection projection(scene.georeference.crs, scene.places.geographic);
  const Place street = find_place("lange strasse", scene, projection);
  EXPECT_EQ(street.name, "Lange Straße");
  ASSERT_TRUE(street.stand);
  const scene::CameraPose before{{0, 50, 300}, {0, 50, 0}, {0, 1, 0}, 33};
  const scene::CameraPose pose = look_at_place(street, before);
  EXPECT_EQ(pose.fov_deg, 33);
  EXPECT_NEAR(pose.position.y, 1.7, 0.01);
  EXPECT_NEAR(pose.position.z, 60, 0.01);
  EXPECT_GT(std::abs(glm::normalize(pose.target - pose.position).x), 0.99);
}

TEST(Places, TheSameTextAgainGoesRoundAllThatItNames) {
  const scene::RenderScene scene = make_scene_with_places();
  const MapProjection projection("");
  std::vector<std::string> names;
  for (std::size_t turn = 0; turn < 3; ++turn)
    names.push_back(find_place("Straß", scene, projection, turn).name);
  EXPECT_EQ(names[0].find("Straßburger Platz, the first of 2 whose names contain"), 0u) << names[0];
  EXPECT_EQ(names[1].find("Lange Straße, number 2 of 2"), 0u) << names[1];
  EXPECT_EQ(names[2], names[0]);
  // Streets come before objects.
  EXPECT_EQ(find_place("gat", scene, projection).name.find("Gate Street"), 0u);
  EXPECT_EQ(find_place("gat", scene, projection, 1).name.find("Building gate, number 2 of 2"), 0u);
}

TEST(Places, WhatIsNotThereIsSaidWithWhatThereIs) {
  const scene::RenderScene scene = make_scene();
  EXPECT_NE(error_of("Unter den Linden", scene).find("names of streets"), std::string::npos);
  EXPECT_NE(error_of("Unter den Linden", make_scene_with_places()).find("none of the 3 streets"),
            std::string::npos);
  EXPECT_NE(error_of("48.1, 11.5", scene).find("outside"), std::string::npos);
  EXPECT_NE(error_of("48.1, 11.5", scene).find("km"), std::string::npos);
  EXPECT_NE(error_of("", scene), "");
  EXPECT_NE(error_of("  ", scene), "");
  EXPECT_NE(error_of("91, 200", scene), "");
  EXPECT_NE(error_of(std::string(100000, '7'), scene), "");
  scene::RenderScene nowhere = make_scene();
  nowhere.georeference.crs = "";
  EXPECT_NE(error_of("52 N, 13 E", nowhere).find("no CRS"), std::string::npos);
  nowhere.georeference.crs = "EPSG:28992";
  EXPECT_NE(error_of("52 N, 13 E", nowhere).find("this city is in EPSG:28992"), std::string::npos);
  nowhere.georeference.crs = "EPSG:1";
  EXPECT_NE(error_of("52 N, 13 E", nowhere), "");
}

TEST(Places, TheCameraLooksAtThemFromTheSideWhereItWas) {
  const scene::CameraPose before{{0, 50, 300}, {0, 50, 0}, {0, 1, 0}, 50};  // to the north
  const scene::CameraPose pose = look_at_place({{10, 0, 20}, 0, ""}, before);
  EXPECT_EQ(pose.target, glm::vec3(10, 0, 20));
  EXPECT_NEAR(pose.position.x, 10, 1e-3);
  EXPECT_GT(pose.position.z, 20);
  EXPECT_GT(pose.position.y, 20);
  const scene::CameraPose far = look_at_place({{10, 0, 20}, 200, ""}, before);
  EXPECT_GT(glm::distance(far.position, far.target), 200 / std::sin(0.4363));
}

TEST(Compass, BearingsAndScaleBarsAreThoseOfTheMap) {
  const auto bearing = [](glm::vec3 ahead) {
    return find_bearing({{0, 0, 0}, ahead, {0, 1, 0}, 60});
  };
  EXPECT_NEAR(bearing({0, 0, -1}), 0, 1e-4);
  EXPECT_NEAR(bearing({1, 0, 0}), 90, 1e-4);
  EXPECT_NEAR(bearing({0, -0.5f, 1}), 180, 1e-4);
  EXPECT_NEAR(bearing({-1, 3, 0}), 270, 1e-4);
  // 90 degrees over 100 pixels at 50 m: a metre each.
  const scene::CameraPose pose{{0, 0, 0}, {0, 0, -50}, {0, 1, 0}, 90};
  for (const auto& [most, metres] :
       {std::pair{9.9f, 5.0}, {10.1f, 10.0}, {19.0f, 10.0}, {21.0f, 20.0}, {60.0f, 50.0}}) {
    const ScaleBar bar = find_scale_bar(pose, 50, 100, most);
    EXPECT_EQ(bar.metres, metres);
    EXPECT_NEAR(bar.pixels, metres, 1e-3);
  }
  EXPECT_EQ(find_scale_bar(pose, 0, 100, 50).pixels, 0);
}

}  // namespace
}  // namespace nightcity::viewer
