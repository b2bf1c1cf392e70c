// Work on many threads whose results are taken in order, whatever the number of threads.
#pragma once

#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace nightcity {

/// Returns the arena of so many threads, the same in each call: TBB 2021.8 takes the longer for an
/// arena the more there have been.
inline oneapi::tbb::task_arena& keep_arena(int threads) {
  static std::mutex mutex;
  // Never destroyed: TBB may be gone before.
  static auto& arenas = *new std::map<int, oneapi::tbb::task_arena>;
  const std::lock_guard lock(mutex);
  return arenas.try_emplace(threads, threads).first->second;
}

/// `next()` returns an std::optional item, none at the end; `work` turns an item into a result, on
/// many threads at once; `take` gets the results one at a time, in the order of next(). With one
/// thread they are called one after the other. At most two items per thread are in work. `threads`:
/// 0 = one per core.
template <class Next, class Work, class Take>
void in_order(unsigned threads, const Next& next, const Work& work, const Take& take) {
  namespace tbb = oneapi::tbb;
  using Item = typename std::decay_t<decltype(next())>::value_type;
  using Result = std::decay_t<decltype(work(std::declval<Item>()))>;
  const int cores = tbb::this_task_arena::max_concurrency();
  const int used =
      threads > 0 ? std::min(static_cast<int>(std::min(threads, 1024u)), cores) : cores;
  if (used == 1) {
    while (auto item = next()) take(work(std::move(*item)));
    return;
  }
  // Items and results on their way between filters lie here, because TBB forgets them when a filter
  // throws. The last one is serial and in order, so that a place is free when it comes up again.
  struct Place {
    std::optional<Item> item;
    std::optional<Result> result;
  };
  std::vector<Place> places(static_cast<std::size_t>(2 * used));
  std::size_t begun = 0;
  const auto run = [&] {
    tbb::parallel_pipeline(
        places.size(),
        tbb::make_filter<void, Place*>(tbb::filter_mode::serial_in_order,
                                       [&](tbb::flow_control& flow) -> Place* {
                                         auto item = next();
                                         if (!item) {
                                           flow.stop();
                                           return nullptr;
                                         }
                                         Place& place = places[begun++ % places.size()];
                                         place.item.emplace(std::move(*item));
                                         return &place;
                                       }) &
            tbb::make_filter<Place*, Place*>(tbb::filter_mode::parallel,
                                             [&](Place* place) {
                                               place->result.emplace(work(std::move(*place->item)));
                                               place->item.reset();
                                               return place;
                                             }) &
            tbb::make_filter<Place*, void>(tbb::filter_mode::serial_in_order, [&](Place* place) {
              take(std::move(*place->result));
              place->result.reset();
            }));
  };
  keep_arena(used).execute([&] { tbb::this_task_arena::isolate(run); });
}

}  // namespace nightcity
