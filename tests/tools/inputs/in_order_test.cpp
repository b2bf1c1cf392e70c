#include "tools/in_order.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/task_scheduler_observer.h>

#include <atomic>
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

// Counts the threads that enter an arena.
class EntryCounter : public oneapi::tbb::task_scheduler_observer {
 public:
  explicit EntryCounter(oneapi::tbb::task_arena& arena) : task_scheduler_observer(arena) {
    observe(true);
  }
  ~EntryCounter() override { observe(false); }
  void on_scheduler_entry(bool) override { ++entries_; }
  int entries() const { return entries_; }

 private:
  std::atomic<int> entries_{0};
};

// TBB 2021.8 takes longer for an arena the more there have been, and a city may have ten thousand
// files, each of which is read in order.
TEST(InOrder, CallsShareOneArenaForEachNumberOfThreads) {
  oneapi::tbb::task_arena& arena = keep_arena(2);
  EXPECT_EQ(arena.max_concurrency(), 2);
  EXPECT_NE(&keep_arena(3), &arena);
  EntryCounter counter(arena);
  for (int call = 0, before = 0; call < 3; ++call, before = counter.entries()) {
    double_in_order(2, 8);
    EXPECT_GT(counter.entries(), before) << "in another arena";
    EXPECT_EQ(&keep_arena(2), &arena);
  }
}

}  // namespace
}  // namespace nightcity
