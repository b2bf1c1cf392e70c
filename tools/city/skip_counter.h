// Counts by name, cheap enough to count every element that is not used.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>

namespace nightcity::city {

class SkipCounter {
 public:
  void add(std::string_view name, std::size_t count = 1) {
    const auto at = counts_.find(name);
    if (at != counts_.end())
      at->second += count;
    else
      counts_.emplace(name, count);
  }
  void merge_into(std::map<std::string, std::size_t>& all) const {
    for (const auto& [name, count] : counts_) all[name] += count;
  }

 private:
  struct Hash {
    using is_transparent = void;
    std::size_t operator()(std::string_view s) const { return std::hash<std::string_view>()(s); }
  };
  std::unordered_map<std::string, std::size_t, Hash, std::equal_to<>> counts_;
};

}  // namespace nightcity::city
