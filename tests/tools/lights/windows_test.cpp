// Windows of several objects: what stands in front of them, their identities and their light.
#include "tools/lights/windows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <set>

#include "formats/rgb9e5.h"
#include "tools/lights/kept_schedules.h"
#include "tools/lights/window_houses.h"

namespace nightcity::lights {
namespace {

using namespace test;

TEST(Windows, PartyWallsAndWallsNearbyHaveNoneAndTheRestStay) {
  const auto faces = [](const WindowSet& set, const glm::vec3& normal, double x_from, double x_to,
                        double above = 0) {
    std::size_t count = 0;
    for (const LitRectangle& w : set.windows)
      count += glm::dot(w.normal, normal) > 0.99f && w.centre.x > east + x_from &&
               w.centre.x < east + x_to && w.centre.z > ground_z + above;
    return count;
  };
  const WindowSet row =
      windows_of({make_house(0, 0, 12, 10, 9.8, "a"), make_house(12, 0, 24, 10, 9.8, "b"),
                  make_house(24.3, 0, 36, 10, 9.8, "c")});
  EXPECT_GT(faces(row, {-1, 0, 0}, -1, 1), 0u);    // the free end of a
  EXPECT_EQ(faces(row, {1, 0, 0}, 11, 13), 0u);    // a's wall to b
  EXPECT_EQ(faces(row, {-1, 0, 0}, 11, 13), 0u);   // b's wall to a
  EXPECT_EQ(faces(row, {1, 0, 0}, 23, 24.1), 0u);  // 30 cm from c
  EXPECT_GT(faces(row, {0, -1, 0}, 0, 12), 0u);
  EXPECT_GT(row.report.left_out.at("something before it"), 0u);
  // A low neighbour only covers the low windows.
  const WindowSet step =
      windows_of({make_house(0, 0, 12, 10, 16, "a"), make_house(12, 0, 24, 10, 5, "b")});
  EXPECT_GT(faces(step, {1, 0, 0}, 11, 13, 5), 0u);
  EXPECT_EQ(faces(step, {1, 0, 0}, 11, 13), faces(step, {1, 0, 0}, 11, 13, 5));
}

TEST(Windows, HousesInsideAnotherHaveNoneWhoeverElseHasItsBack) {
  // The back of the outer house is that of two others too, which have no front.
  const city::CityObject outer = make_house(-10, -10, 22, 20, 12, "outer");
  city::CityObject back = outer;
  back.polygons = {outer.polygons[2]};  // from (22, 20) to (-10, 20)
  std::vector<city::CityObject> objects;
  for (const char* id : {"back 1", "back 2", "back 3"}) {
    back.id = id;
    objects.push_back(back);
  }
  objects.push_back(outer);
  // The front is the outer house's alone.
  const auto count_at_front = [](const WindowSet& set) {
    return std::count_if(set.windows.begin(), set.windows.end(),
                         [](const LitRectangle& w) { return w.normal.y < -0.99f; });
  };
  const auto alone = count_at_front(windows_of(objects));
  EXPECT_GT(alone, 0);
  for (const char* id : {"inner 1", "inner 2", "inner 3"})
    objects.push_back(make_house(0, 0, 12, 10, 9.8, id));
  const WindowSet set = windows_of(objects);
  EXPECT_EQ(count_at_front(set), alone);
  EXPECT_GT(set.report.left_out.at("inside another building"), 0u);
}

TEST(Windows, ModelledWindowsMaySitDeepInTheirWalls) {
  std::size_t kept = 0;
  for (int n = 0; n < 20; ++n) {  // enough houses that some windows are lit
    city::CityObject house = make_house(0, 0, 12, 10, 6, ("house " + std::to_string(n)).c_str());
    city::Polygon window = make_wall({{3, 0.2}, {4.5, 0.2}}, {1, 1}, {2.2, 2.2});
    window.surface = city::SurfaceType::window;
    house.polygons.push_back(window);
    const WindowSet set = windows_of({house});
    EXPECT_FALSE(set.report.left_out.contains("something before it"));
    kept += set.windows.size();
  }
  EXPECT_GT(kept, 10u);
}

TEST(Windows, NoneIsBelowTheGround) {
  const place::HeightAt slope = [](const glm::dvec2& p) {
    return std::optional(ground_z + (p.x - east) * 0.5);
  };
  const WindowSet set = windows_of({make_house(0, 0, 20, 10, 12.8)}, slope);
  EXPECT_GT(set.report.left_out.at("below the ground"), 0u);
  ASSERT_GT(set.windows.size(), 0u);
  for (const LitRectangle& w : set.windows)
    EXPECT_GT(w.centre.z - static_cast<double>(w.half_height),
              ground_z + (w.centre.x - east) * 0.5 - 0.2);
}

TEST(Windows, SameBuildingSameWindowsWhateverElseIsThere) {
  const WindowSet alone = windows_of({make_house(0, 0, 14, 10, 9.8, "same")});
  const WindowSet among =
      windows_of({make_house(100, 0, 130, 20, 12, "other"), make_house(0, 0, 14, 10, 9.8, "same"),
                  make_house(200, 0, 230, 20, 12, "third")});
  std::map<std::uint32_t, const LitRectangle*> by_id;
  for (const LitRectangle& w : among.windows) by_id[w.id] = &w;
  ASSERT_GT(alone.windows.size(), 5u);
  EXPECT_EQ(by_id.size(), among.windows.size());
  for (const LitRectangle& w : alone.windows) {
    ASSERT_TRUE(by_id.contains(w.id));
    EXPECT_EQ(by_id[w.id]->centre, w.centre);
    EXPECT_EQ(by_id[w.id]->hours, w.hours);
  }
}

TEST(Windows, LightIsOneSidedLambertianOfItsLuminance) {
  const WindowSet set = windows_of({make_house(0, 0, 14, 10, 9.8)});
  Georeference georeference;
  georeference.origin = {east, north, ground_z};
  test::KeptSchedules kept;
  for (const LitRectangle& w : set.windows) {
    const Light light = to_light(w, georeference, kept.table);
    ASSERT_LT(light.schedule, kept.schedules.size());
    for (int minute = 0; minute < night_minutes; minute += 5)
      EXPECT_EQ(is_lit(kept.schedules[light.schedule], kept.switches,
                       night_begin_s + 60 * static_cast<uint>(minute)),
                w.hours.lit_at(minute));
    const double area = 4.0 * w.half_width * w.half_height;
    EXPECT_NEAR(light.flux_lm, std::numbers::pi * w.luminance_cd_m2 * area, 1e-3 * light.flux_lm);
    EXPECT_EQ(light_kind(light), LightKind::rectangle);
    EXPECT_EQ(light_profile(light), LIGHT_NO_PROFILE);
    EXPECT_NEAR(glm::length(light.axis), 1, 1e-5);
    EXPECT_NEAR(glm::dot(light.axis, light.tangent), 0, 1e-5);
    EXPECT_NEAR(light.axis.y, 0, 1e-5);
    EXPECT_NEAR(light.position.x, w.centre.x - east, 1e-3);
    EXPECT_NEAR(light.position.z, -(w.centre.y - north), 1e-3);
    EXPECT_NEAR(light.axis.z, -w.normal.y, 1e-5);
    EXPECT_NEAR(luminance(decode_rgb9e5(light.colour_rgb9e5)), 1, 0.01);
    // In front of its wall, not in it.
    const bool outside = w.centre.x < east || w.centre.x > east + 14 || w.centre.y < north ||
                         w.centre.y > north + 10;
    EXPECT_TRUE(outside);
  }
}

TEST(Windows, HoursAreCountedByUse) {
  city::CityObject shop = make_house(100, 0, 130, 20, 9, "shop");
  shop.function = "31001_2010";
  const WindowSet set = windows_of({make_house(0, 0, 30, 20, 12, "flats"), shop});
  ASSERT_EQ(set.report.by_use.size(), 2u);
  std::size_t placed = 0;
  HourCounts lit{};
  for (const LitRectangle& w : set.windows) count_hours(w.hours, lit);
  for (const auto& [name, use] : set.report.by_use) {
    placed += use.placed;
    for (std::size_t hour = 0; hour < night_hours; ++hour) lit[hour] -= use.lit[hour];
  }
  EXPECT_EQ(placed, set.windows.size());
  EXPECT_EQ(lit, HourCounts{});
}

TEST(Windows, WallsOfOtherThingsStandInTheWayToo) {
  city::CityObject fence = make_house(-10, -0.6, 40, -0.3, 3, "noise barrier");
  fence.type = city::ObjectType::other;
  const WindowSet set = windows_of({make_house(0, 0, 30, 20, 12, "flats"), fence});
  for (const LitRectangle& w : set.windows)
    if (w.normal.y < -0.9f) {
      EXPECT_GT(w.centre.z, ground_z + 3);
    }
  EXPECT_GT(set.report.left_out.at("something before it"), 0u);
}

TEST(Windows, NoneLiesInsideABuildingThatOverlapsItsOwn) {
  // The extension overlaps the house. None of its walls is within half a metre of the
  // house's east wall.
  const WindowSet set = windows_of(
      {make_house(0, 0, 20, 20, 12, "house"), make_house(15, 2, 28, 18, 12, "extension")});
  for (const LitRectangle& w : set.windows) {
    const bool in_extension = w.centre.x > east + 15 && w.centre.x < east + 28 &&
                              w.centre.y > north + 2 && w.centre.y < north + 18;
    const bool in_house = w.centre.x < east + 20 && w.centre.x > east && w.centre.y > north &&
                          w.centre.y < north + 20;
    EXPECT_FALSE(in_extension || in_house) << w.centre.x - east << " " << w.centre.y - north;
  }
  EXPECT_GT(set.report.left_out.at("inside another building"), 0u);
  EXPECT_GT(set.windows.size(), 40u);
}

TEST(Windows, WhoeverKnowsWhatLiesInsideIsAsked) {
  const test::TempFolder folder;
  WindowLayout layout({}, folder / "scratch");
  layout.add(make_house(0, 0, 30, 20, 12, "flats"));
  std::size_t east_half = 0;
  const WindowReport report = std::move(layout).finish(
      {}, [&](const LitRectangle& w) { east_half += w.centre.x > east + 15; },
      [](const glm::dvec3& p) { return p.x > east + 15; });
  EXPECT_EQ(east_half, 0u);
  EXPECT_GT(report.placed, 10u);
  EXPECT_GT(report.left_out.at("inside another building"), 10u);
}

TEST(Windows, BuildingsWithoutIdsDifferByTheirPlace) {
  const WindowSet set =
      windows_of({make_house(0, 0, 14, 10, 9.8, ""), make_house(100, 0, 114, 10, 9.8, "")});
  std::set<std::uint32_t> ids;
  for (const LitRectangle& w : set.windows) ids.insert(w.id);
  EXPECT_EQ(ids.size(), set.windows.size());
}

TEST(Windows, PiecesOfOneLargeBuildingHaveEachTheirOwnIdentities) {
  const WindowSet set =
      windows_of({make_house(0, 0, 14, 10, 9.8, "a"), make_house(100, 0, 114, 10, 9.8, "a")});
  std::set<std::uint32_t> ids;
  for (const LitRectangle& w : set.windows) ids.insert(w.id);
  EXPECT_EQ(ids.size(), set.windows.size());
}

}  // namespace
}  // namespace nightcity::lights
