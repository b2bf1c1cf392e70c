// Shares of lit windows over a large sample, and which windows go dark together.
#include "tools/lights/occupancy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "tools/lights/window_houses.h"

namespace nightcity::lights {
namespace {

using namespace test;

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

/// Returns the windows of a house with many storeys, by its function.
WindowSet tall(const char* function, const char* id) {
  city::CityObject house = make_house(0, 0, 40, 24, 25, id);
  house.function = function;
  return windows_of({house});
}

TEST(Occupancy, AStaircaseIsLitOverAllItsStoreysAtOnce) {
  // Windows above each other on one facade agree on a staircase and differ in rooms.
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

}  // namespace
}  // namespace nightcity::lights
