#include "tools/in_order.h"

#include <gtest/gtest.h>

#include <ctime>
#include <vector>

namespace nightcity {
namespace {

// Hands over the numbers from 0 on, doubled on the way.
std::vector<int> double_in_order(unsigned threads, int count) {
  std::vector<int> taken;
  int given = 0;
  in_order(
      threads,
      [&]() -> std::optional<int> { return given < count ? std::optional(given++) : std::nullopt; },
      [](int number) { return 2 * number; }, [&](int number) { taken.push_back(number); });
  return taken;
}

TEST(InOrder, ResultsComeInTheOrderOfTheItems) {
  std::vector<int> expected;
  for (int i = 0; i < 1000; ++i) expected.push_back(2 * i);
  for (const unsigned threads : {0u, 1u, 2u, 64u})
    EXPECT_EQ(double_in_order(threads, 1000), expected) << threads;
}

// A city may have ten thousand files.
TEST(InOrder, ATenThousandthCallTakesNoLongerThanTheFirst) {
  const auto measure = [](int calls) {
    const std::clock_t begin = std::clock();
    for (int call = 0; call < calls; ++call) double_in_order(0, 1);
    return std::clock() - begin;
  };
  measure(100);  // threads are made
  const std::clock_t first = measure(2000);
  measure(8000);
  EXPECT_LT(measure(2000), 4 * first + CLOCKS_PER_SEC / 20);
}

}  // namespace
}  // namespace nightcity
