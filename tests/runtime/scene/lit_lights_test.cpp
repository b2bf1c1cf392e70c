#include "runtime/scene/lit_lights.h"

#include <gtest/gtest.h>

#include "runtime/scene/alias_table.h"
#include "runtime/scene/light_grid.h"
#include "support/alias_probabilities.h"
#include "support/scenes.h"

namespace nightcity::scene {
namespace {

TEST(LitLights, TablesHoldExactlyTheLightsThatShine) {
  std::vector<Light> lights;
  for (int i = 0; i < 100; ++i) lights.push_back(test::lamp({float(i), 5, 0}, 100.0f + float(i)));
  for (std::size_t i = 0; i < lights.size(); i += 2) lights[i].schedule = 0;
  lights[99].flux_lm = 0;
  const std::vector<Schedule> schedules{{0, 2}};
  const std::vector<std::uint32_t> switches{1000, 2000};
  const std::vector<LightFamily> families(lights.size(), LightFamily::lamp);
  for (const double time : {500.0, 1500.0}) {
    const LitLights lit = lit_lights(lights, families, schedules, switches, time);
    const std::vector<float> flux = flux_of(lit, lights);
    const LightGrid near = build_light_grid(lights, flux, near_lists);
    const std::vector<double> p = test::find_probabilities(build_alias_table(flux));
    double sum = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const bool shines = i != 99 && (i % 2 == 1 || time == 1500);
      EXPECT_EQ((lit.bits[i / 32] >> (i % 32) & 1u) != 0, shines) << i;
      EXPECT_EQ(std::count(lit.list.begin(), lit.list.end(), i), shines) << i;
      EXPECT_EQ(p[i] > 0, shines) << i;
      EXPECT_NEAR(p[i], shines ? double{lights[i].flux_lm} / lit.flux_lm : 0, 1e-7) << i;
      sum += p[i];
      for (const gpu::GridEntry& entry : near.entries)
        EXPECT_TRUE(shines || (entry.light != i && entry.alias_light != i)) << i;
    }
    EXPECT_NEAR(sum, 1, 1e-5);
  }
}

}  // namespace
}  // namespace nightcity::scene
