#include "tools/lights/wall_crowds.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace nightcity::lights {

bool WallCrowds::holds(std::uint32_t crowd, std::uint32_t owner) const {
  return std::binary_search(owners[crowd].begin(), owners[crowd].end(), owner);
}

std::size_t WallCrowds::size() const {
  std::size_t count = 2 * kept.size();
  for (const std::vector<std::uint32_t>& crowd : owners) count += crowd.size();
  return count;
}

WallCrowds find_crowds(std::span<const WallPlace> places, std::span<const std::uint32_t> owners) {
  std::vector<std::uint32_t> order(places.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(places[a], a) < std::tie(places[b], b);
  });
  WallCrowds crowds;
  crowds.kept.reserve(places.size());
  for (auto begin = order.begin(); begin != order.end();) {
    const auto end = std::find_if(
        begin, order.end(), [&](std::uint32_t wall) { return places[wall] != places[*begin]; });
    const auto other = std::find_if(
        begin, end, [&](std::uint32_t wall) { return owners[wall] != owners[*begin]; });
    crowds.kept.push_back({*begin});
    if (other != end) {
      crowds.kept.push_back({*other});
      std::vector<std::uint32_t> all;
      for (auto wall = begin; wall != end; ++wall) all.push_back(owners[*wall]);
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
      if (all.size() > 2) {
        const auto crowd = static_cast<std::uint32_t>(crowds.owners.size());
        for (std::size_t back : {1, 2}) crowds.kept[crowds.kept.size() - back].crowd = crowd;
        crowds.owners.push_back(std::move(all));
      }
    }
    begin = end;
  }
  std::sort(crowds.kept.begin(), crowds.kept.end(),
            [](const auto& a, const auto& b) { return a.wall < b.wall; });
  return crowds;
}

}  // namespace nightcity::lights
