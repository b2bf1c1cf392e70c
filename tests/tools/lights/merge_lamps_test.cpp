#include "tools/lights/merge_lamps.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nightcity::lights {
namespace {

PlacedLamp lamp_at(double x, double y, double flux_lm) {
  PlacedLamp lamp;
  lamp.foot = {x, y, 0};
  lamp.mounting_height_m = 6;
  lamp.flux_lm = flux_lm;
  lamp.radius_m = 0.1;
  return lamp;
}

double sum_of_flux(const LampSet& set) {
  double sum = 0;
  for (const PlacedLamp& lamp : set.lamps) sum += lamp.flux_lm;
  return sum;
}

TEST(MergeLamps, TheStrongestTakesInItsNeighboursAndTheFluxStays) {
  LampSet set;
  set.lamps = {lamp_at(0, 0, 1000), lamp_at(8, 0, 3000), lamp_at(16, 0, 2000), lamp_at(40, 0, 500)};
  EXPECT_EQ(merge_lamps(10, set), 2u);
  ASSERT_EQ(set.lamps.size(), 2u);
  EXPECT_EQ(set.lamps[0].foot.x, 8);
  EXPECT_EQ(set.lamps[0].flux_lm, 6000);
  EXPECT_NEAR(set.lamps[0].radius_m, 0.1 * std::sqrt(3.0), 1e-12);
  EXPECT_EQ(set.lamps[1].flux_lm, 500) << "too far from the others";
  EXPECT_EQ(sum_of_flux(set), 6500);
}

TEST(MergeLamps, TheOrderOfEqualLampsDecidesNothing) {
  LampSet set, turned;
  for (int n = 0; n < 60; ++n) set.lamps.push_back(lamp_at(7.0 * n, 0, 100));
  turned.lamps.assign(set.lamps.rbegin(), set.lamps.rend());
  merge_lamps(12, set);
  merge_lamps(12, turned);
  ASSERT_EQ(set.lamps.size(), turned.lamps.size());
  for (std::size_t n = 0; n < set.lamps.size(); ++n)
    EXPECT_EQ(set.lamps[n].foot, turned.lamps[set.lamps.size() - 1 - n].foot);
}

TEST(MergeLamps, NoLampMovesFartherThanTheDistance) {
  LampSet set;
  for (int n = 0; n < 200; ++n) set.lamps.push_back(lamp_at(3.0 * n, std::fmod(7.3 * n, 40), 100));
  const std::vector<PlacedLamp> before = set.lamps;
  merge_lamps(12, set);
  EXPECT_LT(set.lamps.size(), 150u);
  EXPECT_NEAR(sum_of_flux(set), 20000, 1e-9);
  for (const PlacedLamp& lamp : before) {
    double nearest = 1e9;
    for (const PlacedLamp& kept : set.lamps)
      nearest = std::min(nearest, std::hypot(kept.foot.x - lamp.foot.x, kept.foot.y - lamp.foot.y));
    EXPECT_LE(nearest, 12);
  }
}

TEST(MergeLamps, LampsOfOtherKindsStay) {
  const auto lamps_left = [](const auto& change) {
    LampSet set;
    set.lamps = {lamp_at(0, 0, 1000), lamp_at(1, 0, 1000)};
    change(set.lamps[1]);
    merge_lamps(10, set);
    return set.lamps.size();
  };
  EXPECT_EQ(lamps_left([](PlacedLamp&) {}), 1u);
  EXPECT_EQ(lamps_left([](PlacedLamp& lamp) { lamp.profile = 3; }), 2u);
  EXPECT_EQ(lamps_left([](PlacedLamp& lamp) { lamp.colour = {1, 0.9f, 0.8f}; }), 2u);
  EXPECT_EQ(lamps_left([](PlacedLamp& lamp) { lamp.hours = dark_between(60, 120); }), 2u);
  EXPECT_EQ(lamps_left([](PlacedLamp& lamp) { lamp.aim = {0, -1}; }), 2u);
}

TEST(MergeLamps, ADistanceOfZeroChangesNothing) {
  LampSet set;
  set.lamps = {lamp_at(0, 0, 1), lamp_at(0, 0, 2)};
  EXPECT_EQ(merge_lamps(0, set), 0u);
  EXPECT_EQ(set.lamps.size(), 2u);
}

}  // namespace
}  // namespace nightcity::lights
