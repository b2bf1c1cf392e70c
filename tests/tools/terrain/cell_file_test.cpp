#include "tools/cell_file.h"

#include <gtest/gtest.h>

#include <map>
#include <thread>
#include <vector>

#include "support/temp_folder.h"
#include "tools/cell_cache.h"

namespace nightcity::terrain {
namespace {

struct Record {
  int key, number;
  bool operator==(const Record&) const = default;
};

TEST(CellFile, GivesEachCellItsRecordsInTheOrderInWhichTheyCame) {
  const test::TempFolder folder;
  CellFile<int, Record> file(folder / "x", 7);  // of 5000: most have long been written
  std::map<int, std::vector<Record>> all;
  unsigned state = 1;
  for (int n = 0; n < 5000; ++n) {
    state = state * 1664525u + 1013904223u;
    const int key = static_cast<int>(state >> 24) % 40 - 20;
    file.add(key, {key, n});
    all[key].push_back({key, n});
    if (n % 500 == 3) {
      EXPECT_EQ(file.read(key), all[key]);  // with the records that are not written yet
    }
  }
  std::vector<int> keys;
  for (const auto& [key, records] : all) {
    keys.push_back(key);
    EXPECT_EQ(file.read(key), records);
  }
  EXPECT_EQ(file.keys(), keys);
  EXPECT_TRUE(file.read(1000).empty());
  EXPECT_EQ(folder.entries(), 0u) << "a scratch file has no name";
}

struct Cell {
  int value;
  std::size_t cost() const { return 1; }
};

TEST(CellCache, GivesWhatWasLoadedAndForgetsWhatIsNotAskedFor) {
  CellCache<int, Cell> cache(10);
  int loads = 0;
  const auto ask = [&](int key) {
    return cache
        .get(key,
             [&] {
               ++loads;
               return Cell{key * key};
             })
        ->value;
  };
  for (int round = 0; round < 100; ++round) {
    EXPECT_EQ(ask(3), 9);
    EXPECT_EQ(ask(round + 10), (round + 10) * (round + 10));
  }
  EXPECT_EQ(loads, 101) << "3 is asked for all the time";
  ask(10);
  EXPECT_EQ(loads, 102) << "10 has been forgotten";
}

TEST(CellCache, ServesManyThreads) {
  CellCache<int, Cell> cache(20);
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int n = 0; n < 20'000; ++n) {
        const int key = (n * (t + 1)) % 61;
        wrong[static_cast<std::size_t>(t)] +=
            cache.get(key, [&] { return Cell{-key}; })->value != -key;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

}  // namespace
}  // namespace nightcity::terrain
