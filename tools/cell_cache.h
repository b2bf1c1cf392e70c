// A cache of a CellFile's cells in the form in which they are used.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "formats/median.h"

namespace nightcity {

/// `Loaded` has cost() const, in the unit of `max_cost`. May be used from many threads.
template <class Key, class Loaded>
class CellCache {
 public:
  explicit CellCache(std::size_t max_cost) : max_cost_(max_cost) {}

  /// Returns the cell, from `load()` where it is not in the cache; one load at a time.
  template <class Load>
  std::shared_ptr<const Loaded> get(const Key& key, const Load& load) {
    const std::lock_guard lock(mutex_);
    Entry& entry = entries_[key];
    if (!entry.loaded) {
      entry.loaded = std::make_shared<const Loaded>(load());
      cost_ += entry.loaded->cost();
    }
    entry.last_use = ++clock_;
    auto result = entry.loaded;
    if (cost_ > max_cost_) forget_older_half();
    return result;
  }

  /// Forgets all cells: what is asked for next is loaded anew.
  void clear() {
    const std::lock_guard lock(mutex_);
    entries_.clear();
    cost_ = 0;
  }

 private:
  struct Entry {
    std::shared_ptr<const Loaded> loaded;
    std::uint64_t last_use = 0;
  };

  // Half at a time, so that finding the oldest costs little on average.
  void forget_older_half() {
    std::vector<std::uint64_t> uses;
    for (const auto& [key, entry] : entries_) uses.push_back(entry.last_use);
    const std::uint64_t middle = median(std::move(uses));
    std::erase_if(entries_, [&](const auto& item) {
      if (item.second.last_use >= middle) return false;
      cost_ -= item.second.loaded->cost();
      return true;
    });
  }

  std::mutex mutex_;
  std::map<Key, Entry> entries_;
  std::size_t max_cost_, cost_ = 0;
  std::uint64_t clock_ = 0;
};

}  // namespace nightcity
