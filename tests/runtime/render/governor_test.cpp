// The governor against simulated devices: times that jump, drift and are noisy.
#include "runtime/render/governor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "formats/error.h"

namespace nightcity::render {
namespace {

std::vector<Rung> make_rungs() {
  std::vector<Rung> rungs;
  for (const double ms : {2.0, 3.0, 4.5, 6.75, 10.0}) {
    Rung rung;
    rung.ms = ms;
    rung.relative_error = 1 / ms;
    rungs.push_back(rung);
  }
  return rungs;
}

TEST(Rungs, LeadFromOneCandidateToTheSettingsInSmallSteps) {
  for (const std::uint32_t candidates : {1u, 3u, 8u, 32u, 100u})
    for (const std::uint32_t neighbours : {0u, 1u, 4u, 9u}) {
      RenderSettings settings;
      settings.sampling.candidates = candidates;
      settings.reuse.neighbours = neighbours;
      const std::vector<Rung> rungs = list_rungs(settings);
      EXPECT_EQ(rungs.front().effort, (Effort{1, 0}));
      EXPECT_EQ(rungs.back().effort, (Effort{candidates, neighbours}));
      for (std::size_t i = 1; i < rungs.size(); ++i) {
        EXPECT_GE(rungs[i].effort.max_candidates, rungs[i - 1].effort.max_candidates);
        EXPECT_GE(rungs[i].effort.max_neighbours, rungs[i - 1].effort.max_neighbours);
        EXPECT_LE(rungs[i].effort.max_candidates, 2 * rungs[i - 1].effort.max_candidates);
        EXPECT_LE(rungs[i].effort.max_neighbours, rungs[i - 1].effort.max_neighbours + 1);
      }
    }
}

TEST(Rungs, OfTheReferenceAreOne) {
  RenderSettings settings;
  settings.sampling.estimator = Estimator::reference;
  EXPECT_EQ(list_rungs(settings).size(), 1u);
}

TEST(Governor, StartsWithTheDearestThatKeepsTheBudget) {
  EXPECT_EQ(Governor(make_rungs(), {.budget_ms = 8.0}).rung(), 3u);
  EXPECT_EQ(Governor(make_rungs(), {.budget_ms = 100.0}).rung(), 4u);
  EXPECT_EQ(Governor(make_rungs(), {.budget_ms = 0.1}).rung(), 0u) << "nothing does";
}

TEST(Governor, TakesNoMoreThanTheTargetNeeds) {
  const Governor governor(make_rungs(), {.target_error = 0.3});
  EXPECT_EQ(governor.rung(), 2u);
  EXPECT_TRUE(governor.can_keep_target());
  const Governor both(make_rungs(), {.budget_ms = 4.0, .target_error = 0.3});
  EXPECT_EQ(both.rung(), 1u) << "the budget goes before the target";
  EXPECT_EQ(both.top(), 2u);
  const Governor never(make_rungs(), {.target_error = 0.01});
  EXPECT_FALSE(never.can_keep_target());
  EXPECT_EQ(never.rung(), 4u);
}

TEST(Governor, RefusesWhatItCannotGovern) {
  EXPECT_THROW(Governor({}, {.budget_ms = 1}), UsageError);
  EXPECT_THROW(Governor(make_rungs(), {}), UsageError);
  EXPECT_THROW(Governor(make_rungs(), {.budget_ms = std::nan("")}), UsageError);
}

TEST(Governor, IgnoresTimesThatAreNone) {
  Governor governor(make_rungs(), {.budget_ms = 8});
  for (const double ms : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    governor.observe(ms);
  EXPECT_TRUE(governor.decisions().empty());
  EXPECT_EQ(governor.frames(), 4u);
}

TEST(Governor, StaysWhereItIsWhileNothingChanges) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(1, 0.03);
  Governor governor(make_rungs(), {.budget_ms = 8});
  for (int i = 0; i < 5000; ++i)
    governor.observe(governor.rungs()[governor.rung()].ms * noise(random));
  EXPECT_TRUE(governor.decisions().empty());
}

// A view that is twice as dear from one frame to the next: one frame is above the budget, and none
// after it. When it is over, the governor returns.
TEST(Governor, LosesOneFrameToAJumpAndComesBack) {
  Governor governor(make_rungs(), {.budget_ms = 8});
  std::size_t above = 0;
  const auto fly = [&](int frames, double load) {
    for (int i = 0; i < frames; ++i) {
      const double ms = governor.rungs()[governor.rung()].ms * load;
      above += ms > 8;
      governor.observe(ms);
    }
  };
  fly(100, 1);
  fly(200, 2);
  EXPECT_EQ(above, 1u);
  EXPECT_EQ(governor.rung(), 1u);
  fly(400, 1);
  EXPECT_EQ(above, 1u);
  EXPECT_EQ(governor.rung(), 3u);
}

// Loads that swing slowly by a third about the one that was measured, with noise, over ten minutes
// at 60 frames: at most 1 % of the frames are above the budget, and changes are at least half a
// second apart on average.
TEST(Governor, KeepsTheBudgetInNinetyNineOfAHundredFramesWithoutFlicker) {
  std::mt19937 random(2);
  std::normal_distribution<double> noise(1, 0.03);
  Governor governor(make_rungs(), {.budget_ms = 8});
  constexpr int frames = 36000;
  int above = 0;
  for (int i = 0; i < frames; ++i) {
    const double load = 1 + 0.33 * std::sin(i / 300.0);
    const double ms = governor.rungs()[governor.rung()].ms * load * noise(random);
    above += ms > 8;
    governor.observe(ms);
  }
  EXPECT_LT(above, frames / 100);
  EXPECT_LT(governor.decisions().size(), std::size_t(frames) / 30);
  for (const Governor::Decision& decision : governor.decisions()) {
    EXPECT_NE(decision.from, decision.to);
    EXPECT_FALSE(decision.reason.empty());
  }
}

// The next rung looks affordable and is not: its measured time was half of the true one. The
// governor tries it ever more seldom.
TEST(Governor, TriesWhatFailedEverMoreSeldom) {
  std::vector<Rung> rungs = make_rungs();
  Governor governor(rungs, {.budget_ms = 5});
  EXPECT_EQ(governor.rung(), 1u);
  int above = 0;
  for (int i = 0; i < 6000; ++i) {
    const double ms = governor.rung() >= 2 ? 9.0 : 1.5;
    above += ms > 5;
    governor.observe(ms);
  }
  EXPECT_LT(above, 60);
}

}  // namespace
}  // namespace nightcity::render
