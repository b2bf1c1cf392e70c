// Windows on boxes, rows and gables whose every wall is known; shares of lit windows over a large sample.
#include "tools/lights/windows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <set>

#include "formats/rgb9e5.h"
#include "support/data.h"
#include "support/temp_folder.h"
#include "tools/lights/kept_schedules.h"
#include "tools/lights/osm_uses.h"
#include "tools/lights/wall_plane.h"

namespace nightcity {
namespace {

constexpr double east = 412000, north = 5762000, ground_z = 50;

Polygon wall(std::vector<glm::dvec2> plan, std::vector<double> bottom, std::vector<double> top) {
  Polygon polygon;
  polygon.surface = SurfaceType::wall;
  const auto at = [&](std::size_t n, double z) {
    return glm::dvec3(east + plan[n].x, north + plan[n].y, ground_z + z);
  };
  polygon.exterior = {at(0, bottom[0]), at(1, bottom[1]), at(1, top[1]), at(0, top[0])};
  return polygon;
}

/// A flat-roofed box from (x0, y0) to (x1, y1), `height` above the ground.
CityObject box(double x0, double y0, double x1, double y1, double height,
               const char* id = "house") {
  CityObject building;
  building.id = id;
  building.type = ObjectType::building;
  building.function = "31001_1010";
  const glm::dvec2 corners[4] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  for (int k = 0; k < 4; ++k)
    building.polygons.push_back(wall({corners[k], corners[(k + 1) % 4]}, {0, 0}, {height, height}));
  Polygon roof;
  roof.surface = SurfaceType::roof;
  for (const glm::dvec2& c : corners)
    roof.exterior.emplace_back(east + c.x, north + c.y, ground_z + height);
  building.polygons.push_back(roof);
  return building;
}

std::vector<WindowPlace> lay(const CityObject& building,
                             BuildingUse use = BuildingUse::residential) {
  FacadeReport report;
  return lay_windows(building, use, 1, report);
}

TEST(Facades, WindowsLieInsideTheirWallsApartFromEachOtherAndFaceOut) {
  const CityObject house = box(0, 0, 14, 10, 9.8);
  const auto places = lay(house);
  ASSERT_GT(places.size(), 20u);
  for (std::size_t m = 0; m < places.size(); ++m) {
    const WindowPlace& p = places[m];
    EXPECT_NEAR(glm::length(p.normal), 1, 1e-12);
    EXPECT_NEAR(p.normal.z, 0, 1e-12);
    const glm::dvec3 middle(east + 7, north + 5, p.centre.z);
    EXPECT_GT(glm::dot(p.normal, p.centre - middle), 0);
    EXPECT_GT(p.centre.z - p.half_height, ground_z + 0.5);
    EXPECT_LT(p.centre.z + p.half_height, ground_z + 9.8);
    // On its wall's plane, and its ends on the wall.
    for (const double side : {-1.0, 1.0}) {
      const glm::dvec3 end = p.centre + p.along * (side * p.half_width);
      EXPECT_GT(end.x, east - 1e-9);
      EXPECT_LT(end.x, east + 14 + 1e-9);
      EXPECT_GT(end.y, north - 1e-9);
      EXPECT_LT(end.y, north + 10 + 1e-9);
    }
    for (std::size_t n = m + 1; n < places.size(); ++n) {
      if (places[n].facade != p.facade) continue;
      const glm::dvec3 d = places[n].centre - p.centre;
      const bool apart = std::abs(glm::dot(d, p.along)) > p.half_width + places[n].half_width ||
                         std::abs(d.z) > p.half_height + places[n].half_height;
      EXPECT_TRUE(apart);
    }
  }
}

TEST(Facades, StoreysComeFromTheAttributeAndBaysAlignOverThem) {
  CityObject house = box(0, 0, 20, 10, 12.8);
  house.storeys_above_ground = 4;
  FacadeReport report;
  const auto places = lay_windows(house, BuildingUse::residential, 1, report);
  EXPECT_EQ(report.storeys_from_attribute, 1u);
  std::map<std::uint16_t, std::set<std::uint16_t>> bays_by_storey;
  std::map<std::pair<int, int>, double> x_of_bay;
  std::set<long> heights;
  for (const WindowPlace& p : places) {
    if (p.facade != 0) continue;
    bays_by_storey[p.storey].insert(p.bay);
    const auto [known, is_new] = x_of_bay.try_emplace({p.facade, p.bay}, p.centre.x);
    if (!is_new) {
      EXPECT_NEAR(known->second, p.centre.x, 1e-9);
    }
    heights.insert(std::lround(p.centre.z * 1000));
  }
  EXPECT_EQ(bays_by_storey.size(), 4u);
  for (const auto& [storey, bays] : bays_by_storey) EXPECT_EQ(bays, bays_by_storey[0]);
  EXPECT_EQ(heights.size(), 4u);
  EXPECT_NEAR(static_cast<double>(*std::next(heights.begin()) - *heights.begin()), 3000,
              1);  // (12.8 - 0.8) / 4
}

TEST(Facades, UnbelievableStoreysAreNotBelieved) {
  for (const int storeys : {1, 50, 9999, 0, -3}) {
    CityObject house = box(0, 0, 20, 10, 12.8);
    house.storeys_above_ground = storeys;
    FacadeReport report;
    lay_windows(house, BuildingUse::residential, 1, report);
    EXPECT_EQ(report.storeys_from_height, 1u) << storeys;
  }
}

TEST(Facades, CoplanarWallsSideBySideAreOneFacade) {
  CityObject split = box(0, 0, 20, 10, 9.8);
  split.polygons[0] = wall({{0, 0}, {9, 0}}, {0, 0}, {9.8, 9.8});
  split.polygons.push_back(wall({{9, 0}, {20, 0}}, {0, 0}, {9.8, 9.8}));
  const auto whole = lay(box(0, 0, 20, 10, 9.8)), parts = lay(split);
  std::set<long> x_whole, x_parts;
  for (const WindowPlace& p : whole)
    if (p.normal.y < -0.9) x_whole.insert(std::lround(p.centre.x * 1000));
  for (const WindowPlace& p : parts)
    if (p.normal.y < -0.9) x_parts.insert(std::lround(p.centre.x * 1000));
  EXPECT_TRUE(std::includes(x_whole.begin(), x_whole.end(), x_parts.begin(), x_parts.end()));
  EXPECT_GE(x_parts.size() + 1, x_whole.size());  // one may fall onto the seam
}

TEST(Facades, HolesSliversRoofsAndLeaningWallsStayFree) {
  CityObject house = box(0, 0, 20, 10, 9.8);
  Ring hole;  // a passage through the front
  for (const auto& [x, z] : {std::pair{8.0, 0.5}, {8.0, 6.0}, {12.0, 6.0}, {12.0, 0.5}})
    hole.emplace_back(east + x, north, ground_z + z);
  house.polygons[0].interiors.push_back(hole);
  for (const WindowPlace& p : lay(house)) {
    if (p.normal.y > -0.9) continue;
    const bool beside =
        p.centre.x + p.half_width < east + 8 || p.centre.x - p.half_width > east + 12;
    const bool above = p.centre.z - p.half_height > ground_z + 6;
    EXPECT_TRUE(beside || above);
  }
  EXPECT_TRUE(lay(box(0, 0, 1.5, 1.5, 30)).empty());  // a chimney
  CityObject roof_only = house;
  for (Polygon& polygon : roof_only.polygons) polygon.surface = SurfaceType::roof;
  EXPECT_TRUE(lay(roof_only).empty());
  CityObject leaning = box(0, 0, 20, 10, 9.8);
  leaning.polygons.resize(1);
  for (std::size_t k = 2; k < 4; ++k) leaning.polygons[0].exterior[k].y += 9;
  EXPECT_TRUE(lay(leaning).empty());
}

TEST(Facades, GablesHoldWindowsOnlyWhereTheyFit) {
  CityObject house = box(0, 0, 12, 10, 6);
  Polygon& gable = house.polygons[1];  // x = 12, y from 0 to 10
  gable.exterior.insert(gable.exterior.begin() + 3, {east + 12, north + 5, ground_z + 12});
  std::size_t in_gable = 0;
  for (const WindowPlace& p : lay(house)) {
    if (p.normal.x < 0.9) continue;
    const double top = ground_z + 12 - std::abs(p.centre.y - north - 5) / 5 * 6;
    const double shoulder =
        ground_z + 12 - (std::abs(p.centre.y - north - 5) + p.half_width) / 5 * 6;
    EXPECT_LT(p.centre.z + p.half_height, std::min(top, shoulder));
    in_gable += p.centre.z > ground_z + 6;
  }
  EXPECT_GT(in_gable, 0u);
}

TEST(Facades, ModelledWindowsReplaceTheRule) {
  CityObject house = box(0, 0, 12, 10, 6);
  Polygon window = wall({{3, 0}, {4.5, 0}}, {1, 1}, {2.2, 2.2});
  window.surface = SurfaceType::window;
  house.polygons.push_back(window);
  const auto places = lay(house);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_TRUE(places[0].modelled);
  EXPECT_NEAR(places[0].half_width, 0.75, 1e-9);
  EXPECT_NEAR(places[0].half_height, 0.6, 1e-9);
  EXPECT_NEAR(places[0].centre.x, east + 3.75, 1e-9);
}

TEST(Facades, ShopsTakeTheGroundFloorOfMixedHouses) {
  std::size_t shops = 0;
  for (const WindowPlace& p : lay(box(0, 0, 20, 12, 14), BuildingUse::mixed)) {
    EXPECT_EQ(p.kind == WindowKind::shop, p.storey == 0);
    shops += p.kind == WindowKind::shop;
  }
  EXPECT_GT(shops, 5u);
  EXPECT_TRUE(lay(box(0, 0, 20, 12, 14), BuildingUse::dark).empty());
}

struct WindowSet {
  std::vector<LitRectangle> windows;
  WindowReport report;
};

WindowSet windows_of(std::vector<CityObject> objects, const HeightAt& ground = {}) {
  const test::TempFolder folder;
  WindowLayout layout({}, folder / "scratch");
  for (const CityObject& object : objects) layout.add(object);
  WindowSet set;
  set.report =
      std::move(layout).finish(ground, [&](const LitRectangle& w) { set.windows.push_back(w); });
  EXPECT_EQ(set.report.placed, set.windows.size());
  return set;
}

TEST(Windows, PartyWallsAndWallsNearbyHaveNoneAndTheRestStay) {
  const auto faces = [](const WindowSet& set, const glm::vec3& normal, double x_from, double x_to,
                        double above = 0) {
    std::size_t count = 0;
    for (const LitRectangle& w : set.windows)
      count += glm::dot(w.normal, normal) > 0.99f && w.centre.x > east + x_from &&
               w.centre.x < east + x_to && w.centre.z > ground_z + above;
    return count;
  };
  const WindowSet row = windows_of(
      {box(0, 0, 12, 10, 9.8, "a"), box(12, 0, 24, 10, 9.8, "b"), box(24.3, 0, 36, 10, 9.8, "c")});
  EXPECT_GT(faces(row, {-1, 0, 0}, -1, 1), 0u);    // the free end of a
  EXPECT_EQ(faces(row, {1, 0, 0}, 11, 13), 0u);    // a's wall to b
  EXPECT_EQ(faces(row, {-1, 0, 0}, 11, 13), 0u);   // b's wall to a
  EXPECT_EQ(faces(row, {1, 0, 0}, 23, 24.1), 0u);  // 30 cm before c
  EXPECT_GT(faces(row, {0, -1, 0}, 0, 12), 0u);
  EXPECT_GT(row.report.dropped.at("something before it"), 0u);
  // A low neighbour covers the low windows only.
  const WindowSet step = windows_of({box(0, 0, 12, 10, 16, "a"), box(12, 0, 24, 10, 5, "b")});
  EXPECT_GT(faces(step, {1, 0, 0}, 11, 13, 5), 0u);
  EXPECT_EQ(faces(step, {1, 0, 0}, 11, 13), faces(step, {1, 0, 0}, 11, 13, 5));
}

TEST(Windows, ModelledWindowsMaySitDeepInTheirWalls) {
  std::size_t kept = 0;
  for (int n = 0; n < 20; ++n) {  // enough houses that somebody has light on
    CityObject house = box(0, 0, 12, 10, 6, ("house " + std::to_string(n)).c_str());
    Polygon window = wall({{3, 0.2}, {4.5, 0.2}}, {1, 1}, {2.2, 2.2});
    window.surface = SurfaceType::window;
    house.polygons.push_back(window);
    const WindowSet set = windows_of({house});
    EXPECT_FALSE(set.report.dropped.contains("something before it"));
    kept += set.windows.size();
  }
  EXPECT_GT(kept, 10u);
}

TEST(Windows, NoneIsBelowTheGround) {
  const HeightAt slope = [](const glm::dvec2& p) {
    return std::optional(ground_z + (p.x - east) * 0.5);
  };
  const WindowSet set = windows_of({box(0, 0, 20, 10, 12.8)}, slope);
  EXPECT_GT(set.report.dropped.at("below the ground"), 0u);
  ASSERT_GT(set.windows.size(), 0u);
  for (const LitRectangle& w : set.windows)
    EXPECT_GT(w.centre.z - static_cast<double>(w.half_height),
              ground_z + (w.centre.x - east) * 0.5 - 0.2);
}

TEST(Windows, SameBuildingSameWindowsWhateverElseIsThere) {
  const WindowSet alone = windows_of({box(0, 0, 14, 10, 9.8, "same")});
  const WindowSet among =
      windows_of({box(100, 0, 130, 20, 12, "other"), box(0, 0, 14, 10, 9.8, "same"),
                  box(200, 0, 230, 20, 12, "third")});
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
  const WindowSet set = windows_of({box(0, 0, 14, 10, 9.8)});
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
    EXPECT_EQ(light.kind_profile & 255u, LIGHT_RECTANGLE);
    EXPECT_EQ(light.kind_profile >> 8, LIGHT_NO_PROFILE);
    EXPECT_NEAR(glm::length(light.axis), 1, 1e-5);
    EXPECT_NEAR(glm::dot(light.axis, light.tangent), 0, 1e-5);
    EXPECT_NEAR(light.axis.y, 0, 1e-5);
    EXPECT_NEAR(light.position.x, w.centre.x - east, 1e-3);
    EXPECT_NEAR(light.position.z, -(w.centre.y - north), 1e-3);
    EXPECT_NEAR(light.axis.z, -w.normal.y, 1e-5);
    EXPECT_NEAR(luminance(decode_rgb9e5(light.colour_rgb9e5)), 1, 0.01);
    // Before its wall, not in it.
    const bool outside = w.centre.x < east || w.centre.x > east + 14 || w.centre.y < north ||
                         w.centre.y > north + 10;
    EXPECT_TRUE(outside);
  }
}

double share_lit(BuildingUse use, WindowKind kind, int minute) {
  int lit = 0;
  constexpr int homes = 6000, rooms = 3;
  for (int home = 0; home < homes; ++home) {
    Random people{1, home};
    const Household household = draw_household(use, people, Random{7, home});
    for (int room = 0; room < rooms; ++room) {
      Random random{2, home, room};
      lit += draw_window(household, kind, random).schedule.lit_at(minute);
    }
  }
  return static_cast<double>(lit) / (homes * rooms);
}

TEST(Occupancy, SharesOfLitWindowsFollowTheHoursAimedAt) {
  const struct {
    BuildingUse use;
    WindowKind kind;
    int hour;
    double share;
  } table[] = {
      {BuildingUse::residential, WindowKind::room, 18, 0.45},
      {BuildingUse::residential, WindowKind::room, 20, 0.55},
      {BuildingUse::residential, WindowKind::room, 22, 0.40},
      {BuildingUse::residential, WindowKind::room, 23, 0.25},
      {BuildingUse::residential, WindowKind::room, 0, 0.12},
      {BuildingUse::residential, WindowKind::room, 3, 0.03},
      {BuildingUse::residential, WindowKind::room, 6, 0.25},
      {BuildingUse::office, WindowKind::room, 18, 0.65},
      {BuildingUse::office, WindowKind::room, 20, 0.30},
      {BuildingUse::office, WindowKind::room, 22, 0.12},
      {BuildingUse::office, WindowKind::room, 0, 0.06},
      {BuildingUse::mixed, WindowKind::shop, 2, 0.50},
      {BuildingUse::residential, WindowKind::stairs, 22, 0.30},
      {BuildingUse::hotel, WindowKind::lobby, 3, 1.00},
      {BuildingUse::office, WindowKind::lobby, 2, 0.50},
  };
  for (const auto& row : table)
    EXPECT_NEAR(share_lit(row.use, row.kind, minute_of(row.hour, 0)), row.share, 0.06)
        << name_of(row.use) << " at " << row.hour;
}

TEST(Occupancy, RoomsOfOneHomeGoDarkTogether) {
  // Lit at midnight: rooms of one home agree far more often than rooms of different homes.
  const int midnight = minute_of(0, 0);
  int both = 0, first = 0, second = 0;
  constexpr int homes = 8000;
  for (int home = 0; home < homes; ++home) {
    Random people{3, home};
    const Household household = draw_household(BuildingUse::residential, people, Random{7, home});
    Random a{4, home}, b{5, home};
    const bool lit_a = draw_window(household, WindowKind::room, a).schedule.lit_at(midnight);
    const bool lit_b = draw_window(household, WindowKind::room, b).schedule.lit_at(midnight);
    first += lit_a, second += lit_b, both += lit_a && lit_b;
  }
  const double independent = static_cast<double>(first) / homes * second / homes;
  EXPECT_GT(static_cast<double>(both) / homes, 2 * independent);
}

/// A block of flats with shops below, or an office; many storeys.
WindowSet tall(const char* function, const char* id) {
  CityObject house = box(0, 0, 40, 24, 25, id);
  house.function = function;
  return windows_of({house});
}

TEST(Occupancy, AStaircaseIsLitOverAllItsStoreysAtOnce) {
  // Windows above each other on one facade: those of a staircase agree, those of rooms do not.
  std::size_t stair_columns = 0, mixed_columns = 0;
  for (int n = 0; n < 12; ++n) {
    const WindowSet set = tall("31001_1010", ("flats " + std::to_string(n)).c_str());
    std::map<std::pair<long, long>, std::set<NightSchedule>> nights;
    std::map<std::pair<long, long>, std::size_t> heights;
    for (const LitRectangle& w : set.windows) {
      const std::pair column(std::lround(w.centre.x * 10), std::lround(w.centre.y * 10));
      nights[column].insert(w.hours);
      ++heights[column];
    }
    for (const auto& [column, count] : heights)
      if (count >= 6) (nights[column].size() == 1 ? stair_columns : mixed_columns) += 1;
  }
  EXPECT_GE(stair_columns, 6u);
  EXPECT_GT(mixed_columns, 10 * stair_columns);
}

TEST(Occupancy, AShopsWindowsCloseTogether) {
  std::size_t alike = 0, pairs = 0;
  for (int n = 0; n < 12; ++n) {
    const WindowSet set = tall("31001_1120", ("shops " + std::to_string(n)).c_str());
    const LitRectangle* last = nullptr;
    for (const LitRectangle& w : set.windows) {
      if (w.centre.z > ground_z + 4) continue;  // the ground floor
      if (last && glm::dot(w.normal, last->normal) > 0.9f) {
        ++pairs;
        alike += w.hours == last->hours && w.luminance_cd_m2 == last->luminance_cd_m2;
      }
      last = &w;
    }
  }
  EXPECT_GT(pairs, 100u);
  EXPECT_GT(alike, pairs / 2);  // neighbours in one shop: one to three of two to four windows
  EXPECT_LT(alike, pairs);
}

TEST(Occupancy, AnOfficesStoreyIsCleanedInOneGo) {
  int cleaned_pairs = 0, one_cleaned = 0;
  for (int storey = 0; storey < 2000; ++storey) {
    Random a{1, storey}, b{2, storey};
    const bool first = draw_household(BuildingUse::office, a, Random{3, storey}).cleaned >= 0;
    const bool second = draw_household(BuildingUse::office, b, Random{3, storey}).cleaned >= 0;
    one_cleaned += first;
    cleaned_pairs += first && second;
    EXPECT_EQ(first, second);
  }
  EXPECT_NEAR(one_cleaned / 2000.0, 0.3, 0.05);
  EXPECT_EQ(one_cleaned, cleaned_pairs);
}

TEST(Windows, HoursAreCountedByUse) {
  CityObject shop = box(100, 0, 130, 20, 9, "shop");
  shop.function = "31001_2010";
  const WindowSet set = windows_of({box(0, 0, 30, 20, 12, "flats"), shop});
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
  CityObject fence = box(-10, -0.6, 40, -0.3, 3, "noise barrier");
  fence.type = ObjectType::other;
  const WindowSet set = windows_of({box(0, 0, 30, 20, 12, "flats"), fence});
  for (const LitRectangle& w : set.windows)
    if (w.normal.y < -0.9f) {
      EXPECT_GT(w.centre.z, ground_z + 3);
    }
  EXPECT_GT(set.report.dropped.at("something before it"), 0u);
}

TEST(Windows, NoneLiesInsideABuildingThatOverlapsItsOwn) {
  // An extension drawn into the house: no wall of it within half a metre before the house's east wall.
  const WindowSet set =
      windows_of({box(0, 0, 20, 20, 12, "house"), box(15, 2, 28, 18, 12, "extension")});
  for (const LitRectangle& w : set.windows) {
    const bool in_extension = w.centre.x > east + 15 && w.centre.x < east + 28 &&
                              w.centre.y > north + 2 && w.centre.y < north + 18;
    const bool in_house = w.centre.x < east + 20 && w.centre.x > east && w.centre.y > north &&
                          w.centre.y < north + 20;
    EXPECT_FALSE(in_extension || in_house) << w.centre.x - east << " " << w.centre.y - north;
  }
  EXPECT_GT(set.report.dropped.at("inside another building"), 0u);
  EXPECT_GT(set.windows.size(), 40u);
}

TEST(Windows, WhoeverKnowsWhatLiesInsideIsAsked) {
  const test::TempFolder folder;
  WindowLayout layout({}, folder / "scratch");
  layout.add(box(0, 0, 30, 20, 12, "flats"));
  std::size_t east_half = 0;
  const WindowReport report = std::move(layout).finish(
      {}, [&](const LitRectangle& w) { east_half += w.centre.x > east + 15; },
      [](const glm::dvec3& p) { return p.x > east + 15; });
  EXPECT_EQ(east_half, 0u);
  EXPECT_GT(report.placed, 10u);
  EXPECT_GT(report.dropped.at("inside another building"), 10u);
}

TEST(Windows, BuildingsWithoutIdsDifferByTheirPlace) {
  const WindowSet set = windows_of({box(0, 0, 14, 10, 9.8, ""), box(100, 0, 114, 10, 9.8, "")});
  std::set<std::uint32_t> ids;
  for (const LitRectangle& w : set.windows) ids.insert(w.id);
  EXPECT_EQ(ids.size(), set.windows.size());
}

TEST(Windows, PiecesOfOneLargeBuildingHaveEachTheirOwnIdentities) {
  const WindowSet set = windows_of({box(0, 0, 14, 10, 9.8, "a"), box(100, 0, 114, 10, 9.8, "a")});
  std::set<std::uint32_t> ids;
  for (const LitRectangle& w : set.windows) ids.insert(w.id);
  EXPECT_EQ(ids.size(), set.windows.size());
}

TEST(Occupancy, TimesAreInOrderApartAndWithinTheNight) {
  std::set<NightSchedule> distinct;
  for (int n = 0; n < 20000; ++n) {
    Random random{6, n};
    const auto use = static_cast<BuildingUse>(n % 8);
    const Household household = draw_household(use, random, Random{7, n});
    const LitWindow window = draw_window(household, static_cast<WindowKind>(n / 8 % 5), random);
    int last = -1;
    for (std::size_t k = 0; k < 4; ++k) {
      const int on = window.schedule.on[k], off = window.schedule.off[k];
      if (on == off) continue;
      EXPECT_GT(on, last);
      EXPECT_GT(off, on);
      EXPECT_LE(off, night_minutes);
      EXPECT_EQ(on % 5 + off % 5, 0);
      last = off;
    }
    EXPECT_GT(window.luminance_cd_m2, 1);
    EXPECT_LE(window.luminance_cd_m2, 200);
    EXPECT_GE(window.cct_k, 2500);
    distinct.insert(window.schedule);
  }
  EXPECT_GT(distinct.size(), 1000u);
  EXPECT_EQ(minute_of(17, 0), 0);
  EXPECT_EQ(minute_of(0, 30), 450);
  EXPECT_EQ(minute_of(7, 0), night_minutes);
}

TEST(BuildingUse, CodesAndWordsOfRealModels) {
  const struct {
    const char* code;
    BuildingUse use;
  } known[] = {{"31001_1010", BuildingUse::residential},
               {"31001_1120", BuildingUse::mixed},
               {"31001_2020", BuildingUse::office},
               {"31001_2463", BuildingUse::dark},
               {"31001_3041", BuildingUse::dark},
               {"31001_3021", BuildingUse::education},
               {"31001_3012", BuildingUse::civic},
               {"31001_2071", BuildingUse::hotel},
               {"31001_2143", BuildingUse::industrial},
               {"401", BuildingUse::office},
               {"411", BuildingUse::residential},
               {"441", BuildingUse::industrial},
               {"1000", BuildingUse::residential},
               {"1120", BuildingUse::office},
               {"Wohnhaus", BuildingUse::residential},
               {"Office building", BuildingUse::office},
               {"Garage", BuildingUse::dark},
               {"Shop", BuildingUse::retail}};
  for (const auto& [code, use] : known) {
    EXPECT_TRUE(use_from_code(code).stated) << code;
    EXPECT_EQ(use_from_code(code).use, use) << code;
  }
  for (const char* code : {"", "9999", "31001_", "31001_0", "???"})
    EXPECT_FALSE(use_from_code(code).stated) << code;
  CityObject hut = box(0, 0, 4, 4, 2.5);
  hut.function.clear();
  EXPECT_EQ(use_of(hut).use, BuildingUse::dark);
}

TEST(BuildingUse, TheMapSpeaksWhereTheModelIsSilent) {
  const auto outline = [](double x0, double y0, double x1, double y1, OsmTags tags) {
    return OsmWay{1, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}}, std::move(tags)};
  };
  const OsmUses uses({outline(0, 0, 100, 100, {{"building", "retail"}}),
                      outline(10, 10, 20, 20, {{"building", "office"}}),
                      outline(200, 0, 300, 50, {{"building", "yes"}, {"tourism", "hotel"}}),
                      outline(400, 0, 500, 50, {{"building", "yes"}}),
                      {2, {{600, 0}, {700, 0}, {700, 50}}, {{"building", "retail"}}}},
                     [](const glm::dvec2& p) { return glm::dvec2(east, north) + p; });
  const auto at = [&](double x, double y) { return uses.at({east + x, north + y}); };
  EXPECT_EQ(at(50, 50), BuildingUse::retail);
  EXPECT_EQ(at(15, 15), BuildingUse::office);  // the smaller outline
  EXPECT_EQ(at(250, 25), BuildingUse::hotel);
  EXPECT_FALSE(at(450, 25));
  EXPECT_FALSE(at(690, 10));  // not closed
  EXPECT_FALSE(at(-1, 50));
  CityObject house = box(40, 40, 60, 60, 9);
  const UseAt map = [&](const glm::dvec2& p) { return uses.at(p); };
  EXPECT_EQ(use_of(house, map).use, BuildingUse::residential);  // the model's word comes first
  house.function.clear();
  EXPECT_EQ(use_of(house, map).use, BuildingUse::retail);
  EXPECT_TRUE(use_of(house, map).from_map);
  EXPECT_EQ(use_from_tags({{"building", "Semidetached House"}}), BuildingUse::residential);
  EXPECT_EQ(use_from_tags({{"building", "yes"}, {"amenity", "school"}}), BuildingUse::education);
  EXPECT_EQ(use_from_tags({{"building", "church"}, {"shop", "kiosk"}}), BuildingUse::dark);
}

TEST(WallPlane, RectanglesAreInsideWhollyOrNotAtAll) {
  const WallOutline u_shape{{{0, 0}, {10, 0}, {10, 10}, {7, 10}, {7, 4}, {3, 4}, {3, 10}, {0, 10}},
                            {{{1, 1}, {2, 1}, {2, 2}, {1, 2}}},
                            {0, 0},
                            {10, 10}};
  EXPECT_TRUE(contains(u_shape, {0.5, 5}, {2.5, 9}));
  EXPECT_TRUE(contains(u_shape, {3, 0.5}, {9, 3.5}));
  EXPECT_FALSE(contains(u_shape, {4, 5}, {6, 9}));        // in the gap
  EXPECT_FALSE(contains(u_shape, {1, 5}, {9, 6}));        // both corners inside, the middle not
  EXPECT_FALSE(contains(u_shape, {0.5, 0.5}, {2.5, 3}));  // holds the hole
  EXPECT_FALSE(contains(u_shape, {1.2, 1.2}, {1.8, 1.8}));
  EXPECT_FALSE(contains(u_shape, {-1, 5}, {2, 9}));
}

}  // namespace
}  // namespace nightcity
