#include "formats/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <stop_token>
#include <vector>

#include "formats/cancel.h"

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

// Also in work within work, whose threads are others.
TEST(RunParallel, EndsWhereItsCallersTokenAsksForIt) {
  for (const unsigned threads : {1u, 4u}) {
    std::stop_source stop;
    const CancelScope scope(stop.get_token());
    std::atomic<std::size_t> begun = 0;
    EXPECT_THROW(run_parallel(1000, threads,
                              [&](std::size_t) {
                                run_parallel(1000, threads, [&](std::size_t) {
                                  if (++begun == 50) stop.request_stop();
                                });
                              }),
                 Cancelled);
    EXPECT_LT(begun, 50u + threads * threads);
    EXPECT_THROW(throw_if_cancelled(), Cancelled);
  }
  EXPECT_NO_THROW(throw_if_cancelled()) << "the scope has ended";
  run_parallel(10, 4, [](std::size_t) { throw_if_cancelled(); });
}

TEST(CountCores, IsAtLeastOne) {
  EXPECT_GE(count_cores(), 1u);
}

}  // namespace
}  // namespace nightcity
