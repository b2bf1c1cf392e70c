// The tables that candidates are sampled from: alias table and light grid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "runtime/scene/alias_table.h"
#include "runtime/scene/light_grid.h"
#include "support/alias_probabilities.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

TEST(AliasTable, DrawsEachIndexByItsWeight) {
  const std::vector<float> weights{1, 0, 5, 1e-3f, 250, 3, 3, 0.5f};
  const auto table = scene::build_alias_table(weights);
  const auto p = find_probabilities(table);
  double sum = 0;
  for (const float w : weights) sum += double(w);
  for (std::size_t i = 0; i < weights.size(); ++i)
    EXPECT_NEAR(p[i], double(weights[i]) / sum, 1e-7);
}

TEST(AliasTable, AMillionWeightsSumToOneInDouble) {
  std::vector<float> weights(1000000, 0.1f);
  weights[7] = 1e6f;
  const auto p = find_probabilities(scene::build_alias_table(weights));
  double sum = 0;
  for (const double one : p) sum += one;
  EXPECT_NEAR(sum, 1.0, 1e-5);
  EXPECT_NEAR(p[7], 1e6 / (1e6 + 999999 * 0.1), 1e-6);
}

TEST(AliasTable, WeightsThatAreNoNumbersCountAsZero) {
  const std::vector<float> weights{std::numeric_limits<float>::quiet_NaN(), 2, -1,
                                   std::numeric_limits<float>::infinity(), 2};
  const auto p = find_probabilities(scene::build_alias_table(weights));
  EXPECT_NEAR(p[0] + p[2] + p[3], 0, 1e-12);
  EXPECT_NEAR(p[1], 0.5, 1e-7);
}

TEST(AliasTable, WithoutAnyWeightItIsUniform) {
  const std::vector<float> weights(5, 0.0f);
  for (const double p : find_probabilities(scene::build_alias_table(weights)))
    EXPECT_NEAR(p, 0.2, 1e-7);
  EXPECT_TRUE(scene::build_alias_table({}).empty());
}

// The shader decides by the threshold whether a light is in a cell's list, and must agree with the
// list: a light that it takes for listed, and that is not, gets too small a weight.
void expect_membership_by_threshold(const std::vector<Light>& lights) {
  const scene::LightGrid grid = scene::build_light_grid(lights, scene::near_lists);
  ASSERT_EQ(grid.cells.size(), std::size_t{grid.shape.width} * grid.shape.depth);
  for (std::uint32_t z = 0; z < grid.shape.depth; ++z)
    for (std::uint32_t x = 0; x < grid.shape.width; ++x) {
      const gpu::LightCell& cell = grid.cells[z * grid.shape.width + x];
      std::map<std::uint32_t, double> probability;
      for (std::uint32_t i = 0; i < cell.count; ++i) {
        const gpu::GridEntry& entry = grid.entries[cell.first + i];
        probability[entry.light] += double(entry.keep) / cell.count;
        probability[entry.alias_light] += (1.0 - double(entry.keep)) / cell.count;
      }
      for (std::uint32_t light = 0; light < lights.size(); ++light) {
        const float strength = scene::light_strength(grid.shape, x, z, lights[light]);
        const bool member = cell.count > 0 && strength >= cell.threshold;
        const auto listed = probability.find(light);
        ASSERT_EQ(member, listed != probability.end())
            << "cell " << x << ", " << z << " light " << light;
        if (member) {
          ASSERT_NEAR(listed->second, double(strength / cell.strength_sum), 1e-5);
        }
      }
    }
}

TEST(LightGrid, MembershipByThresholdIsMembershipInTheList) {
  std::vector<Light> lights = random_lamps(700, 300, 9);
  for (int i = 0; i < 200; ++i)
    lights.push_back(lamp({float(i % 20) * 16, 6, float(i / 20) * 16}, 3000));  // many ties
  expect_membership_by_threshold(lights);
}

TEST(LightGrid, SoItIsAmongFewLightsOfManyFluxes) {
  std::vector<Light> lights = random_lamps(60, 12, 2);
  for (std::size_t i = 0; i < lights.size(); ++i)
    lights[i].flux_lm = std::pow(10.0f, float(i % 12) - 4);
  expect_membership_by_threshold(lights);
}

TEST(LightGrid, ACellListsItsStrongestLights) {
  const std::vector<Light> lights = random_lamps(2000, 400, 4);
  const scene::LightGrid grid = scene::build_light_grid(lights, scene::near_lists);
  const std::uint32_t x = grid.shape.width / 2, z = grid.shape.depth / 2;
  const gpu::LightCell& cell = grid.cells[z * grid.shape.width + x];
  EXPECT_GT(cell.count, scene::near_lists.listed / 2u);
  std::size_t stronger = 0;
  for (const Light& light : lights)
    stronger += scene::light_strength(grid.shape, x, z, light) >= cell.threshold;
  EXPECT_EQ(stronger, cell.count);
}

// Against a sort of all lights by strength, with classes of flux from 1 to 1000 times the weakest.
TEST(LightGrid, ListsAreThoseOfASortOfAllLights) {
  std::vector<Light> lights = random_lamps(3000, 500, 21);
  for (std::size_t i = 0; i < lights.size(); ++i)
    lights[i].flux_lm = 20 * std::pow(1000.0f, float(i % 7) / 6);
  const scene::LightLists lists{25, 100};
  const scene::LightGrid grid = scene::build_light_grid(lights, lists);
  for (std::uint32_t z = 0; z < grid.shape.depth; z += 3)
    for (std::uint32_t x = 0; x < grid.shape.width; ++x) {
      std::vector<std::pair<float, std::uint32_t>> sorted;
      for (std::uint32_t i = 0; i < lights.size(); ++i)
        sorted.emplace_back(-scene::light_strength(grid.shape, x, z, lights[i]), i);
      std::sort(sorted.begin(), sorted.end());
      std::size_t count = lists.listed;
      while (count > 0 && !(-sorted[count - 1].first > -sorted[count].first * 1.0001f)) --count;
      const gpu::LightCell& cell = grid.cells[z * grid.shape.width + x];
      ASSERT_EQ(cell.count, count) << x << ", " << z;
      std::set<std::uint32_t> listed, expected;
      for (std::uint32_t i = 0; i < cell.count; ++i) {
        listed.insert(grid.entries[cell.first + i].light);
        expected.insert(sorted[i].second);
      }
      ASSERT_EQ(listed, expected) << x << ", " << z;
    }
}

// The search for windows must not end where a stadium's floodlight beyond
// it could still outdo them.
TEST(LightGrid, AStrongLightFarAwayDoesNotShortenTheListsOfWeakOnes) {
  std::vector<Light> lights = random_lamps(2500, 600, 3);
  for (Light& light : lights) light.flux_lm = 40;
  lights.push_back(lamp({590, 20, 590}, 200'000));
  for (const scene::LightLists lists : {scene::near_lists, scene::far_lists}) {
    const scene::LightGrid grid = scene::build_light_grid(lights, lists);
    for (const gpu::LightCell& cell : grid.cells)
      ASSERT_GE(cell.count, std::min<std::size_t>(lists.listed, lights.size()) / 2);
  }
}

TEST(LightGrid, LightsWithoutFluxAreInNoCell) {
  std::vector<Light> lights = random_lamps(10, 50, 2);
  lights[3].flux_lm = 0;
  const scene::LightGrid grid = scene::build_light_grid(lights, scene::near_lists);
  for (const gpu::GridEntry& entry : grid.entries) EXPECT_NE(entry.light, 3u);
  EXPECT_EQ(scene::build_light_grid({}, scene::near_lists).shape.width, 0u);
}

// Distances whose squares are no floats: the grid is made nevertheless, and lists near lights as it
// does without the far one.
TEST(LightGrid, ALightAtTheEndOfTheNumbersLeavesTheOthersListed) {
  for (const float far : {1e8f, 1e18f, 1e20f, 1e30f, 3e38f}) {
    const std::vector<Light> lights{lamp({1, 8, 2}, 5000), lamp({far, far / 2, -far}, 5000)};
    const scene::LightGrid grid = scene::build_light_grid(lights, scene::LightLists{8, 256});
    ASSERT_GT(grid.shape.width, 0u) << far;
    EXPECT_TRUE(std::isfinite(grid.shape.cell_m) && std::isfinite(grid.shape.softening_m2)) << far;
    const auto column = static_cast<std::uint32_t>((1 - grid.shape.origin_x) / grid.shape.cell_m),
               row = static_cast<std::uint32_t>((2 - grid.shape.origin_z) / grid.shape.cell_m);
    const gpu::LightCell& cell = grid.cells.at(row * grid.shape.width + column);
    ASSERT_GE(cell.count, 1u) << far;
    EXPECT_EQ(grid.entries.at(cell.first).light, 0u) << far;
  }
}

// However many lights there are: what lights a place most is in the list of its cell.
TEST(LightGrid, ListsReachTheLightsAboveTheCornersOfTheirCells) {
  constexpr int side = 200;
  constexpr float apart_m = 10;
  std::vector<Light> lights;
  for (int z = 0; z < side; ++z)
    for (int x = 0; x < side; ++x)
      lights.push_back(lamp({float(x) * apart_m, 8, float(z) * apart_m}, 3000));
  const scene::LightGrid grid = scene::build_light_grid(lights, {1, 256, 8, 1 << 14});
  EXPECT_LE(grid.entries.size(), 9 * lights.size());
  const auto nearest = [](float place_m) {
    return std::clamp(int(std::lround(place_m / apart_m)), 0, side - 1);
  };
  for (std::uint32_t z = 0; z < grid.shape.depth; ++z)
    for (std::uint32_t x = 0; x < grid.shape.width; ++x) {
      const gpu::LightCell& cell = grid.cells[z * grid.shape.width + x];
      std::set<std::uint32_t> listed;
      for (std::uint32_t i = 0; i < cell.count; ++i)
        listed.insert(grid.entries[cell.first + i].light);
      for (const std::uint32_t corner : {0u, 1u, 2u, 3u}) {
        const float at_x = grid.shape.origin_x + float(x + corner % 2) * grid.shape.cell_m,
                    at_z = grid.shape.origin_z + float(z + corner / 2) * grid.shape.cell_m;
        ASSERT_TRUE(listed.contains(std::uint32_t(nearest(at_z) * side + nearest(at_x))))
            << x << ", " << z << ", corner " << corner;
      }
    }
}

TEST(LightGrid, AContinentOfLightsKeepsItsCellsCountable) {
  std::vector<Light> lights = random_lamps(1000, 100, 2);
  lights.push_back(lamp({900000, 5, 900000}, 3000));
  const scene::LightGrid grid = scene::build_light_grid(lights, scene::near_lists);
  EXPECT_LE(grid.cells.size(), 70000u);
  // A cell in the empty middle lists nothing, and no cell lists a light below its threshold.
  for (std::uint32_t z = 0; z < grid.shape.depth; z += 7)
    for (std::uint32_t x = 0; x < grid.shape.width; x += 7) {
      const gpu::LightCell& cell = grid.cells[z * grid.shape.width + x];
      std::size_t members = 0;
      for (const Light& light : lights)
        members +=
            cell.count > 0 && scene::light_strength(grid.shape, x, z, light) >= cell.threshold;
      ASSERT_EQ(members, cell.count);
    }
}

}  // namespace
}  // namespace nightcity::test
