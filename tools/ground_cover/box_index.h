// Finds boxes in the plane that meet a rectangle.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <unordered_map>
#include <vector>

namespace nightcity::ground_cover {

using Ring = std::vector<glm::dvec2>;

struct Box {
  glm::dvec2 low, high;
  bool holds(const glm::dvec2& p) const {
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y;
  }
};

/// Returns the box around finite points, of which there is at least one.
Box find_box(const std::vector<std::vector<glm::dvec2>>& rings);

/// An area has nothing of a square, a part, or all of it.
enum class Share : std::uint8_t { none, part, all };

/// Returns what rings, of which an odd number goes round the places of their area, have of a box.
/// Says `part` wherever an outline comes within a millimetre of it.
Share find_share(const std::vector<std::vector<glm::dvec2>>& rings, const Box& box);

/// A box lies in the squares of the grid that is just wider than it, at most four: so any box costs
/// the same, whatever its size. Coordinates in metres, finite and below 1e9.
class BoxIndex {
 public:
  /// Numbers ascend from call to call.
  void add(std::uint32_t number, const Box& box);
  /// Splits squares of many boxes for find_first(), once all are added: areas as long as their
  /// square, which cross it aslant, would all be asked. `find_share(number, box)` says what an area
  /// has of a part of the square, `count_corners(number)` how many corners its rings have. Lists
  /// grow to 256 times their length at most, together. Areas of more than four corners count for as
  /// many as these make: each is a look, and one that winds through its square lies in as many more
  /// parts of it.
  template <class FindShare, class CountCorners>
  void split_crowded(const FindShare& find_share, const CountCorners& count_corners);
  /// Returns the numbers of the boxes whose squares meet a rectangle, each once, in order.
  std::vector<std::uint32_t> find(const Box& box) const;
  /// Returns the least number that `holds` accepts of the boxes whose squares hold a place, or
  /// `none`. After split_crowded(), `holds` must agree with what that was told.
  template <class Holds>
  std::uint32_t find_first(const glm::dvec2& place, const Holds& holds) const;

  static constexpr std::uint32_t none = ~std::uint32_t{0};

 private:
  static constexpr int levels = 28;
  static constexpr std::size_t crowded = 64;  // areas of four corners in a square
  // A square, or a quarter of one that is split.
  struct Part {
    std::vector<std::uint32_t> numbers;
    std::uint32_t first_quarter = 0;  // in parts_; 0: it is not split
  };
  // Returns the boxes of a level that lie in the square of a place, or in the part of it that is
  // not split; null where there are none.
  const std::vector<std::uint32_t>* find_square(const glm::dvec2& place, int level) const;
  static Box find_box_of_square(std::uint64_t key);
  static Box find_quarter(const Box& box, std::uint32_t quarter);

  std::array<bool, levels> used_{};
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> squares_;
  std::vector<Part> parts_;
  std::unordered_map<std::uint64_t, std::uint32_t> split_;  // squares: their places in parts_
};

template <class FindShare, class CountCorners>
void BoxIndex::split_crowded(const FindShare& find_share, const CountCorners& count_corners) {
  constexpr double finest_part_m = 1;
  struct Waiting {
    std::uint32_t part;
    Box box;
  };
  const auto count_looks = [&](const std::vector<std::uint32_t>& numbers) {
    std::size_t corners = 0;
    for (const std::uint32_t number : numbers)
      corners += std::max<std::size_t>(count_corners(number), 4);
    return corners / 4;
  };
  for (const auto& [key, numbers] : squares_) {
    const std::size_t looks = count_looks(numbers);
    if (looks <= crowded) continue;
    split_.emplace(key, static_cast<std::uint32_t>(parts_.size()));
    std::vector<Waiting> waiting{
        {static_cast<std::uint32_t>(parts_.size()), find_box_of_square(key)}};
    parts_.push_back({numbers});
    std::size_t room = 256 * looks;
    // The largest parts first, so that the room is spent evenly.
    for (std::size_t next = 0; next < waiting.size(); ++next) {
      const auto [part, box] = waiting[next];
      const std::vector<std::uint32_t> whole = parts_[part].numbers;
      if (count_looks(whole) <= crowded || 4 * whole.size() > room ||
          box.high.x - box.low.x < 2 * finest_part_m)
        continue;
      parts_[part] = {{}, static_cast<std::uint32_t>(parts_.size())};
      for (std::uint32_t quarter = 0; quarter < 4; ++quarter) {
        const Box inner = find_quarter(box, quarter);
        waiting.push_back({static_cast<std::uint32_t>(parts_.size()), inner});
        std::vector<std::uint32_t>& kept = parts_.emplace_back().numbers;
        for (const std::uint32_t number : whole) {
          const Share share = find_share(number, inner);
          if (share != Share::none) kept.push_back(number);
          if (share == Share::all) break;  // no later one is the first
        }
        room -= kept.size();
      }
    }
  }
}

template <class Holds>
std::uint32_t BoxIndex::find_first(const glm::dvec2& place, const Holds& holds) const {
  std::uint32_t first = none;
  for (int level = 0; level < levels; ++level) {
    const std::vector<std::uint32_t>* square = find_square(place, level);
    if (!square) continue;
    for (const std::uint32_t number : *square) {
      if (number >= first) break;  // a square's numbers ascend
      if (!holds(number)) continue;
      first = number;
      break;
    }
  }
  return first;
}

}  // namespace nightcity::ground_cover
