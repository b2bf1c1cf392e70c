#include "formats/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace nightcity {
namespace {

TEST(RunParallel, DoesEachIndexOnceForAnyNumberOfThreads) {
  for (const unsigned threads : {0u, 1u, 3u, 64u}) {
    std::vector<std::atomic<int>> done(1000);
    run_parallel(done.size(), threads, [&](std::size_t i) { ++done[i]; });
    for (const std::atomic<int>& times : done) EXPECT_EQ(times, 1);
  }
  run_parallel(0, 4, [](std::size_t) { FAIL(); });
}

TEST(RunParallel, ThrowsTheFirstExceptionAndBeginsNoMore) {
  for (const unsigned threads : {1u, 4u}) {
    std::atomic<std::size_t> begun = 0;
    EXPECT_THROW(run_parallel(1'000'000, threads,
                              [&](std::size_t i) {
                                ++begun;
                                if (i == 5) throw std::runtime_error("five");
                              }),
                 std::runtime_error);
    EXPECT_LT(begun, 1'000'000u);
  }
}

TEST(CountCores, IsAtLeastOne) {
  EXPECT_GE(count_cores(), 1u);
}

}  // namespace
}  // namespace nightcity
