#include "runtime/experiments/price_choice.h"

#include <gtest/gtest.h>

#include <numeric>

namespace nightcity::experiments {
namespace {

using Cuts = std::vector<std::size_t>;

// Errors that add up, as they do at most.
MeasureCuts adding(const std::vector<Cut>& cuts) {
  return [&cuts](const Cuts& made, bool) {
    return std::accumulate(made.begin(), made.end(), 0.0,
                           [&](double sum, std::size_t cut) { return sum + cuts[cut].error; });
  };
}

TEST(ChooseCuts, TakesTheCheapestErrorFirstAndStaysWithinTheLimit) {
  const std::vector<Cut> cuts{{"", 0.6, 0.1}, {"", 0.5, 0.4}, {"", 0.4, 0.3}, {"", 2, 0.9}};
  const CutChoice choice = choose_cuts(cuts, 1, adding(cuts));
  EXPECT_EQ(choice.cuts, (Cuts{1, 2}));
  EXPECT_NEAR(choice.error, 0.9, 1e-12);
  EXPECT_TRUE(choice.trials.back().is_verification);
}

TEST(ChooseCuts, MakesNoCutThatSavesNothing) {
  const std::vector<Cut> cuts{{"", 0, 0}, {"", 0, 0.1}, {"", 0.1, -0.2}};
  EXPECT_EQ(choose_cuts(cuts, 1, adding(cuts)).cuts, (Cuts{1}));
}

TEST(ChooseCuts, MakesNoneWhereNoneKeepsTheLimit) {
  const std::vector<Cut> cuts{{"", 2, 0.5}, {"", 3, 0.9}};
  const CutChoice choice = choose_cuts(cuts, 1, [](const Cuts&, bool) -> double {
    ADD_FAILURE() << "there is nothing to measure";
    return 0;
  });
  EXPECT_TRUE(choice.cuts.empty());
  EXPECT_EQ(choice.error, 0);
}

TEST(ChooseCuts, MakesOneOfAGroupTheOneThatSavesMostWithinTheLimit) {
  // Bounces: three, two, one, none.
  const std::vector<Cut> cuts{
      {"bounces", 0.1, 0.1}, {"bounces", 0.4, 0.2}, {"bounces", 0.9, 0.3}, {"bounces", 5, 0.6}};
  EXPECT_EQ(choose_cuts(cuts, 1, adding(cuts)).cuts, (Cuts{2}));
  EXPECT_EQ(choose_cuts(cuts, 0.5, adding(cuts)).cuts, (Cuts{1}));
}

// Errors of opposite sign: together less than their sum.
TEST(ChooseCuts, TriesMoreThanTheSumAllows) {
  const std::vector<Cut> cuts{{"", 0.8, 0.5}, {"", 0.7, 0.4}};
  const CutChoice choice =
      choose_cuts(cuts, 1, [](const Cuts& made, bool) { return made.size() == 2 ? 0.1 : 0.8; });
  EXPECT_EQ(choice.cuts, (Cuts{0, 1}));
}

TEST(ChooseCuts, GivesUpWhatDoesNotHoldInTheVerification) {
  const std::vector<Cut> cuts{{"", 0.1, 0.5}, {"", 0.2, 0.4}, {"", 0.3, 0.3}};
  const CutChoice choice = choose_cuts(cuts, 1, [](const Cuts& made, bool is_verification) {
    return is_verification && made.size() > 1 ? 1.5 : 0.5;
  });
  EXPECT_EQ(choice.cuts, (Cuts{0}));
  EXPECT_EQ(choice.error, 0.5);
}

TEST(ChooseCuts, DropsFromTheFirstSetWhatIsWorseTogether) {
  const std::vector<Cut> cuts{{"", 0.1, 0.5}, {"", 0.2, 0.4}, {"", 0.3, 0.3}};
  const CutChoice choice =
      choose_cuts(cuts, 1, [](const Cuts& made, bool) { return made.size() > 2 ? 1.5 : 0.5; });
  EXPECT_EQ(choice.cuts, (Cuts{0, 1}));
  for (const Trial& trial : choice.trials) EXPECT_EQ(trial.is_kept, trial.error <= 1);
}

}  // namespace
}  // namespace nightcity::experiments
