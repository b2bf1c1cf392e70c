// Work on many threads whose results are taken in order, whatever the number of threads.
#pragma once

#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace nightcity {

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
  // TBB copies what passes between filters, so pointers do.
  using ItemPtr = std::shared_ptr<Item>;
  using ResultPtr = std::shared_ptr<Result>;
  tbb::task_arena arena(used);
  arena.execute([&] {
    tbb::parallel_pipeline(
        static_cast<std::size_t>(2 * used),
        tbb::make_filter<void, ItemPtr>(tbb::filter_mode::serial_in_order,
                                        [&](tbb::flow_control& flow) -> ItemPtr {
                                          auto item = next();
                                          if (item) return std::make_shared<Item>(std::move(*item));
                                          flow.stop();
                                          return {};
                                        }) &
            tbb::make_filter<ItemPtr, ResultPtr>(tbb::filter_mode::parallel,
                                                 [&](const ItemPtr& item) {
                                                   return std::make_shared<Result>(
                                                       work(std::move(*item)));
                                                 }) &
            tbb::make_filter<ResultPtr, void>(
                tbb::filter_mode::serial_in_order,
                [&](const ResultPtr& result) { take(std::move(*result)); }));
  });
}

}  // namespace nightcity
