#include "tools/lights/wall_crowds.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "tools/random.h"

namespace nightcity::lights {

bool WallCrowds::holds(std::uint32_t crowd, std::uint32_t owner) const {
  return std::binary_search(owners[crowd].begin(), owners[crowd].end(), owner);
}

std::size_t WallCrowds::size() const {
  std::size_t count = 2 * kept.size();
  for (const std::vector<std::uint32_t>& crowd : owners) count += crowd.size();
  return count;
}

namespace {

std::uint64_t hash_place(const WallPlace& place) {
  std::uint64_t hash = 0;
  for (const std::uint32_t word : place) hash = mix(hash ^ word);
  return hash;
}

// Returns the walls' numbers, those of one place side by side and in order. Hashes decide, because
// to compare places costs more and mostly all of them differ.
std::vector<std::uint32_t> gather_places(std::span<const WallPlace> places) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
  keys.reserve(places.size());
  for (const WallPlace& place : places)
    keys.emplace_back(hash_place(place), static_cast<std::uint32_t>(keys.size()));
  std::sort(keys.begin(), keys.end(), [&](const auto& a, const auto& b) {
    if (a.first != b.first) return a.first < b.first;
    return std::tie(places[a.second], a.second) < std::tie(places[b.second], b.second);
  });
  std::vector<std::uint32_t> order;
  order.reserve(keys.size());
  for (const auto& [hash, wall] : keys) order.push_back(wall);
  return order;
}

}  // namespace

WallCrowds find_crowds(std::span<const WallPlace> places, std::span<const std::uint32_t> owners) {
  const std::vector<std::uint32_t> order = gather_places(places);
  constexpr std::uint32_t not_kept = no_crowd - 1;
  std::vector<std::uint32_t> crowd_of(places.size(), not_kept);
  WallCrowds crowds;
  for (auto begin = order.begin(); begin != order.end();) {
    const auto end = std::find_if(
        begin, order.end(), [&](std::uint32_t wall) { return places[wall] != places[*begin]; });
    const auto other = std::find_if(
        begin, end, [&](std::uint32_t wall) { return owners[wall] != owners[*begin]; });
    crowd_of[*begin] = no_crowd;
    if (other != end) {
      crowd_of[*other] = no_crowd;
      std::vector<std::uint32_t> all;
      for (auto wall = begin; wall != end; ++wall) all.push_back(owners[*wall]);
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
      if (all.size() > 2) {
        crowd_of[*begin] = crowd_of[*other] = static_cast<std::uint32_t>(crowds.owners.size());
        crowds.owners.push_back(std::move(all));
      }
    }
    begin = end;
  }
  for (std::uint32_t wall = 0; wall < crowd_of.size(); ++wall)
    if (crowd_of[wall] != not_kept) crowds.kept.push_back({wall, crowd_of[wall]});
  return crowds;
}

}  // namespace nightcity::lights
