// Houses whose every wall is known, for the tests of windows.
#pragma once

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "support/temp_folder.h"
#include "tools/lights/windows.h"

namespace nightcity::test {

constexpr double east = 412000, north = 5762000, ground_z = 50;

inline city::Polygon make_wall(std::vector<glm::dvec2> plan, std::vector<double> bottom,
                               std::vector<double> top) {
  city::Polygon polygon;
  polygon.surface = city::SurfaceType::wall;
  const auto at = [&](std::size_t n, double z) {
    return glm::dvec3(east + plan[n].x, north + plan[n].y, ground_z + z);
  };
  polygon.exterior = {at(0, bottom[0]), at(1, bottom[1]), at(1, top[1]), at(0, top[0])};
  return polygon;
}

/// Returns a flat-roofed house from (x0, y0) to (x1, y1), `height` above the ground.
inline city::CityObject make_house(double x0, double y0, double x1, double y1, double height,
                                   const char* id = "house") {
  city::CityObject building;
  building.id = id;
  building.type = city::ObjectType::building;
  building.function = "31001_1010";
  const glm::dvec2 corners[4] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  for (int k = 0; k < 4; ++k)
    building.polygons.push_back(
        make_wall({corners[k], corners[(k + 1) % 4]}, {0, 0}, {height, height}));
  city::Polygon roof;
  roof.surface = city::SurfaceType::roof;
  for (const glm::dvec2& c : corners)
    roof.exterior.emplace_back(east + c.x, north + c.y, ground_z + height);
  building.polygons.push_back(roof);
  return building;
}

struct WindowSet {
  std::vector<lights::LitRectangle> windows;
  lights::WindowReport report;
};

inline WindowSet windows_of(std::vector<city::CityObject> objects,
                            const place::HeightAt& ground = {}) {
  const TempFolder folder;
  lights::WindowLayout layout({}, folder / "scratch");
  for (const city::CityObject& object : objects) layout.add(object);
  WindowSet set;
  set.report = std::move(layout).finish(
      ground, [&](const lights::LitRectangle& w) { set.windows.push_back(w); });
  EXPECT_EQ(set.report.placed, set.windows.size());
  return set;
}

}  // namespace nightcity::test
