// Polygons that an object holds twice, in objects of a few polygons and of many: they are looked
// for in different ways.
#include <gtest/gtest.h>

#include <string>

#include "tests/tools/cityjson/read_text.h"
#include "tests/tools/cityjson/small_cityjson.h"

namespace nightcity::cityjson {
namespace {

// Returns `count` different triangles between the box's corners, 56 at most.
std::string make_triangles(int count) {
  std::string triangles;
  for (int a = 0; a < 8; ++a)
    for (int b = a + 1; b < 8; ++b)
      for (int c = b + 1; c < 8 && count > 0; ++c, --count)
        triangles += (triangles.empty() ? "[[" : ",[[") + std::to_string(a) + "," +
                     std::to_string(b) + "," + std::to_string(c) + "]]";
  return triangles;
}

test::City read_triangles(const std::string& triangles) {
  const std::string geometry =
      "{\"type\":\"MultiSurface\",\"lod\":\"2\",\"boundaries\":[" + triangles + "]}";
  return test::read_city(test::city_json(test::object("a", "Building", geometry)));
}

TEST(RepeatedPolygons, AreLeftOutAndCountedInObjectsOfEverySize) {
  for (const int count : {1, 2, 15, 16, 17, 31, 56}) {
    const auto size = static_cast<std::size_t>(count);
    const test::City once = read_triangles(make_triangles(count));
    ASSERT_EQ(once.objects.size(), 1u);
    EXPECT_EQ(once.objects[0].polygons.size(), size);
    EXPECT_FALSE(once.report.skipped.contains("polygon: repeats another of its object"));
    // The first again, turned, and begun elsewhere.
    const test::City twice = read_triangles(make_triangles(count) + ",[[1,0,2]],[[2,1,0]]");
    ASSERT_EQ(twice.objects.size(), 1u);
    EXPECT_EQ(twice.objects[0].polygons.size(), size);
    EXPECT_EQ(twice.report.skipped.at("polygon: repeats another of its object"), 2u);
  }
}

TEST(RepeatedPolygons, LeaveTheOthersInTheirOrder) {
  const test::City read = read_triangles("[[0,1,2]],[[2,1,0]],[[1,2,3]],[[0,1,2]],[[2,3,4]]");
  ASSERT_EQ(read.objects.size(), 1u);
  ASSERT_EQ(read.objects[0].polygons.size(), 3u);
  // The box's corners lie in steps of a centimetre from 10, 20, 30.
  EXPECT_EQ(read.objects[0].polygons[0].exterior[0], glm::dvec3(10, 20, 30));
  EXPECT_EQ(read.objects[0].polygons[1].exterior[0], glm::dvec3(12, 20, 30));
  EXPECT_EQ(read.objects[0].polygons[2].exterior[0], glm::dvec3(12, 23, 30));
}

}  // namespace
}  // namespace nightcity::cityjson
