#include "tools/lights/window_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tools/lights/window_houses.h"

namespace nightcity::lights {
namespace {

using namespace test;

std::vector<LitRectangle> group(const std::vector<LitRectangle>& windows, WindowGrouping grouping) {
  std::vector<LitRectangle> groups;
  WindowGrouper grouper(grouping, [&](const LitRectangle& each) { groups.push_back(each); });
  for (const LitRectangle& window : windows) grouper.add(window);
  grouper.finish();
  EXPECT_EQ(grouper.emitters(), groups.size());
  return groups;
}

// A window of 1 m x 1 m in the wall y = 0 that faces south.
LitRectangle make_window(double x, double z, float luminance, std::uint16_t on, std::uint32_t id) {
  LitRectangle window;
  window.centre = {x, 0, z};
  window.normal = {0, -1, 0};
  window.along = {1, 0, 0};
  window.half_width = window.half_height = 0.5f;
  window.luminance_cd_m2 = luminance;
  window.cct_k = 3000;
  window.hours.on[0] = on;
  window.hours.off[0] = static_cast<std::uint16_t>(on + 10);
  window.id = id;
  return window;
}

double total_flux(const std::vector<LitRectangle>& windows, int minute = -1) {
  double sum = 0;
  for (const LitRectangle& window : windows)
    if (minute < 0 || window.hours.lit_at(minute)) sum += window.flux_lm();
  return sum;
}

TEST(WindowGroups, OfAStoreyAreTheRectangleRoundItsWindows) {
  const std::vector<LitRectangle> windows{make_window(0, 3, 10, 0, 1), make_window(4, 3, 30, 0, 2),
                                          make_window(2, 6, 20, 0, 3)};
  const auto storeys = group(windows, WindowGrouping::storey);
  ASSERT_EQ(storeys.size(), 2u);
  EXPECT_EQ(storeys[0].half_width, 2.5f);
  EXPECT_EQ(storeys[0].half_height, 0.5f);
  EXPECT_EQ(storeys[0].centre, glm::dvec3(2, 0, 3));
  // 40 cd/m2 on 1 m^2, spread over 5 m^2.
  EXPECT_NEAR(storeys[0].luminance_cd_m2, 8, 1e-5);
  EXPECT_EQ(storeys[1].id, 3u) << "it is alone, and passes as it is";
  EXPECT_EQ(storeys[1].centre, windows[2].centre);
  const auto facade = group(windows, WindowGrouping::facade);
  ASSERT_EQ(facade.size(), 1u);
  EXPECT_EQ(facade[0].centre, glm::dvec3(2, 0, 4.5));
  EXPECT_EQ(facade[0].half_height, 2);
  EXPECT_NEAR(total_flux(facade), total_flux(windows), 1e-3);
  EXPECT_EQ(group(windows, WindowGrouping::none).size(), 3u);
}

TEST(WindowGroups, KeepApartWhatLiesInOtherWallsBuildingsAndFarAway) {
  LitRectangle turned = make_window(1, 3, 10, 0, 2), before = make_window(1, 3, 10, 0, 3),
               other = make_window(1, 3, 10, 0, 4);
  turned.normal = {0, 1, 0};
  turned.along = {-1, 0, 0};
  before.centre.y = -1;
  other.provenance.source_id = 9;
  for (const LitRectangle& second : {turned, before, other, make_window(20, 3, 10, 0, 5)})
    EXPECT_EQ(group({make_window(0, 3, 10, 0, 1), second}, WindowGrouping::facade).size(), 2u)
        << second.id;
  EXPECT_EQ(
      group({make_window(0, 3, 10, 0, 1), make_window(18, 3, 10, 0, 5)}, WindowGrouping::facade)
          .size(),
      1u);
}

// Over 4,000 pairs of a bright window and one of a third of its flux, lit at different times, the
// group is lit in three quarters of the cases when the bright one is: within four standard
// deviations, 0.027.
TEST(WindowGroups, HaveTheExpectedFluxOfTheirWindowsAtEveryMoment) {
  double bright = 0, dim = 0, flux = 0;
  for (std::uint32_t i = 0; i < 4000; ++i) {
    const std::vector<LitRectangle> windows{make_window(0, 3, 30, 100, 2 * i),
                                            make_window(2, 3, 10, 200, 2 * i + 1)};
    const auto groups = group(windows, WindowGrouping::storey);
    ASSERT_EQ(groups.size(), 1u);
    bright += total_flux(groups, 105);
    dim += total_flux(groups, 205);
    flux += total_flux(windows);
  }
  EXPECT_NEAR(bright / flux, 0.75, 0.027);
  EXPECT_NEAR(dim / flux, 0.25, 0.027);
}

TEST(WindowGroups, OfHousesAreFewerAndHaveTheirFluxAndPlaces) {
  std::vector<city::CityObject> houses;
  for (int i = 0; i < 30; ++i)
    houses.push_back(make_house(40 * i, 0, 40 * i + 18, 12, 18, ("h" + std::to_string(i)).c_str()));
  const std::vector<LitRectangle> windows = windows_of(houses).windows;
  const auto storeys = group(windows, WindowGrouping::storey),
             facades = group(windows, WindowGrouping::facade);
  EXPECT_LT(storeys.size(), windows.size() / 2);
  EXPECT_LT(facades.size(), storeys.size() / 2);
  for (const auto& groups : {storeys, facades}) {
    EXPECT_NEAR(total_flux(groups) / total_flux(windows), 1, 1e-5);
    for (const LitRectangle& each : groups) {
      EXPECT_LE(2 * each.half_width, max_window_group_m + 1e-4);
      EXPECT_LE(2 * each.half_height, max_window_group_m + 1e-4);
      EXPECT_GT(each.luminance_cd_m2, 0);
    }
    // Every window lies in a group's rectangle, in its plane.
    for (const LitRectangle& window : windows)
      EXPECT_TRUE(std::any_of(groups.begin(), groups.end(), [&](const LitRectangle& each) {
        const glm::dvec3 place = window.centre - each.centre;
        const glm::dvec3 up = glm::cross(glm::dvec3(each.normal), glm::dvec3(each.along));
        return std::abs(glm::dot(place, glm::dvec3(each.normal))) < 0.1 &&
               std::abs(glm::dot(place, glm::dvec3(each.along))) <= double{each.half_width} &&
               std::abs(glm::dot(place, up)) <= double{each.half_height};
      }));
  }
  const auto again = group(windows, WindowGrouping::storey);
  ASSERT_EQ(again.size(), storeys.size());
  for (std::size_t i = 0; i < again.size(); ++i) EXPECT_EQ(again[i].hours, storeys[i].hours);
}

}  // namespace
}  // namespace nightcity::lights
