// Windows on boxes, rows and gables whose walls are all known.
#include "tools/lights/facades.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "tools/lights/window_houses.h"

namespace nightcity::lights {
namespace {

using namespace test;

std::vector<WindowPlace> windows_on(const city::CityObject& building,
                                    BuildingUse use = BuildingUse::residential) {
  FacadeReport report;
  return place_windows(building, use, 1, report);
}

TEST(Facades, WindowsLieInsideTheirWallsApartFromEachOtherAndFaceOut) {
  const city::CityObject house = make_house(0, 0, 14, 10, 9.8);
  const auto places = windows_on(house);
  ASSERT_GT(places.size(), 20u);
  for (std::size_t m = 0; m < places.size(); ++m) {
    const WindowPlace& p = places[m];
    EXPECT_NEAR(glm::length(p.normal), 1, 1e-12);
    EXPECT_NEAR(p.normal.z, 0, 1e-12);
    const glm::dvec3 middle(east + 7, north + 5, p.centre.z);
    EXPECT_GT(glm::dot(p.normal, p.centre - middle), 0);
    EXPECT_GT(p.centre.z - p.half_height, ground_z + 0.5);
    EXPECT_LT(p.centre.z + p.half_height, ground_z + 9.8);
    // It lies in the plane of its wall, with its ends on the wall.
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

TEST(Facades, ABuildingThatWouldHaveTooManyWindowsGetsNoneAndIsCounted) {
  const city::CityObject house = make_house(0, 0, 14, 10, 9.8);
  const std::size_t all = windows_on(house).size();
  for (const std::size_t limit : {all - 1, all}) {
    FacadeReport report;
    const auto places = place_windows(house, BuildingUse::residential, 1, report, limit);
    EXPECT_EQ(places.size(), limit < all ? 0 : all);
    EXPECT_EQ(report.too_many, limit < all ? 1u : 0u);
  }
  // 50 km long and 30 km high, as by a slip of units: millions of windows.
  FacadeReport report;
  EXPECT_TRUE(
      place_windows(make_house(0, 0, 50000, 50000, 30000), BuildingUse::residential, 1, report)
          .empty());
  EXPECT_EQ(report.too_many, 1u);
}

TEST(Facades, StoreysComeFromTheAttributeAndBaysAlignOverThem) {
  city::CityObject house = make_house(0, 0, 20, 10, 12.8);
  house.storeys_above_ground = 4;
  FacadeReport report;
  const auto places = place_windows(house, BuildingUse::residential, 1, report);
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
    city::CityObject house = make_house(0, 0, 20, 10, 12.8);
    house.storeys_above_ground = storeys;
    FacadeReport report;
    place_windows(house, BuildingUse::residential, 1, report);
    EXPECT_EQ(report.storeys_from_height, 1u) << storeys;
  }
}

TEST(Facades, CoplanarWallsSideBySideAreOneFacade) {
  city::CityObject split = make_house(0, 0, 20, 10, 9.8);
  split.polygons[0] = make_wall({{0, 0}, {9, 0}}, {0, 0}, {9.8, 9.8});
  split.polygons.push_back(make_wall({{9, 0}, {20, 0}}, {0, 0}, {9.8, 9.8}));
  const auto whole = windows_on(make_house(0, 0, 20, 10, 9.8)), parts = windows_on(split);
  std::set<long> x_whole, x_parts;
  for (const WindowPlace& p : whole)
    if (p.normal.y < -0.9) x_whole.insert(std::lround(p.centre.x * 1000));
  for (const WindowPlace& p : parts)
    if (p.normal.y < -0.9) x_parts.insert(std::lround(p.centre.x * 1000));
  EXPECT_TRUE(std::includes(x_whole.begin(), x_whole.end(), x_parts.begin(), x_parts.end()));
  EXPECT_GE(x_parts.size() + 1, x_whole.size());  // one may fall onto the seam
}

TEST(Facades, HolesSliversRoofsAndLeaningWallsStayFree) {
  city::CityObject house = make_house(0, 0, 20, 10, 9.8);
  city::Ring hole;  // a passage through the front
  for (const auto& [x, z] : {std::pair{8.0, 0.5}, {8.0, 6.0}, {12.0, 6.0}, {12.0, 0.5}})
    hole.emplace_back(east + x, north, ground_z + z);
  house.polygons[0].interiors.push_back(hole);
  for (const WindowPlace& p : windows_on(house)) {
    if (p.normal.y > -0.9) continue;
    const bool beside =
        p.centre.x + p.half_width < east + 8 || p.centre.x - p.half_width > east + 12;
    const bool above = p.centre.z - p.half_height > ground_z + 6;
    EXPECT_TRUE(beside || above);
  }
  EXPECT_TRUE(windows_on(make_house(0, 0, 1.5, 1.5, 30)).empty());  // a chimney
  city::CityObject roof_only = house;
  for (city::Polygon& polygon : roof_only.polygons) polygon.surface = city::SurfaceType::roof;
  EXPECT_TRUE(windows_on(roof_only).empty());
  city::CityObject leaning = make_house(0, 0, 20, 10, 9.8);
  leaning.polygons.resize(1);
  for (std::size_t k = 2; k < 4; ++k) leaning.polygons[0].exterior[k].y += 9;
  EXPECT_TRUE(windows_on(leaning).empty());
}

TEST(Facades, GablesHoldWindowsOnlyWhereTheyFit) {
  city::CityObject house = make_house(0, 0, 12, 10, 6);
  city::Polygon& gable = house.polygons[1];  // x = 12, y from 0 to 10
  gable.exterior.insert(gable.exterior.begin() + 3, {east + 12, north + 5, ground_z + 12});
  std::size_t in_gable = 0;
  for (const WindowPlace& p : windows_on(house)) {
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
  city::CityObject house = make_house(0, 0, 12, 10, 6);
  city::Polygon window = make_wall({{3, 0}, {4.5, 0}}, {1, 1}, {2.2, 2.2});
  window.surface = city::SurfaceType::window;
  house.polygons.push_back(window);
  const auto places = windows_on(house);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_TRUE(places[0].modelled);
  EXPECT_NEAR(places[0].half_width, 0.75, 1e-9);
  EXPECT_NEAR(places[0].half_height, 0.6, 1e-9);
  EXPECT_NEAR(places[0].centre.x, east + 3.75, 1e-9);
}

TEST(Facades, ShopsTakeTheGroundFloorOfMixedHouses) {
  std::size_t shops = 0;
  for (const WindowPlace& p : windows_on(make_house(0, 0, 20, 12, 14), BuildingUse::mixed)) {
    EXPECT_EQ(p.kind == WindowKind::shop, p.storey == 0);
    shops += p.kind == WindowKind::shop;
  }
  EXPECT_GT(shops, 5u);
  EXPECT_TRUE(windows_on(make_house(0, 0, 20, 12, 14), BuildingUse::dark).empty());
}

}  // namespace
}  // namespace nightcity::lights
