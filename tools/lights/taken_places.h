// Places that hold a lamp post already.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <unordered_map>

namespace nightcity::lights {

/// A hash grid of the places of posts. Posts nearer to each other than 0.3 m are one post that is
/// mapped twice.
class TakenPlaces {
 public:
  /// Takes the place at p. Returns false if a post stands there already.
  bool take(const glm::dvec2& p) {
    const auto x = cell(p.x), y = cell(p.y);
    for (std::int64_t i = x - 1; i <= x + 1; ++i)
      for (std::int64_t j = y - 1; j <= y + 1; ++j) {
        const auto [first, last] = places_.equal_range(key(i, j));
        for (auto place = first; place != last; ++place)
          if (glm::distance(place->second, p) < same_place_m) return false;
      }
    places_.emplace(key(x, y), p);
    return true;
  }

 private:
  static constexpr double same_place_m = 0.3;

  static std::int64_t cell(double v) {
    return static_cast<std::int64_t>(std::floor(v / same_place_m));
  }
  static std::uint64_t key(std::int64_t x, std::int64_t y) {
    return static_cast<std::uint64_t>(x) << 32 ^ (static_cast<std::uint64_t>(y) & 0xFFFFFFFFu);
  }
  std::unordered_multimap<std::uint64_t, glm::dvec2> places_;
};

}  // namespace nightcity::lights
