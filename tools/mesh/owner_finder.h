// Areas of the plane in layers, and who owns a place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace nightcity::mesh {

/// A place lies in an area when an odd number of its rings go round it. Rings are open, and may
/// touch and cross. Areas with equal labels are one region where they meet.
struct PlaneArea {
  std::vector<std::vector<glm::dvec2>> rings;
  std::uint32_t label = 0;
};

/// Areas in order of priority: the first one that holds a place owns it.
using PlaneLayer = std::vector<PlaneArea>;

constexpr std::uint32_t no_label = std::numeric_limits<std::uint32_t>::max();

/// Returns whether an odd number of the rings go round a place.
bool holds(std::span<const std::vector<glm::dvec2>> rings, const glm::dvec2& place);

/// Finds the owners of places in one layer, by the squares of a grid that the areas' boxes touch.
class OwnerFinder {
 public:
  /// `layer` must outlive the finder.
  explicit OwnerFinder(const PlaneLayer& layer);
  /// Returns the label of the first area that holds the place, or no_label.
  std::uint32_t find(const glm::dvec2& place) const;

 private:
  struct Box {
    glm::dvec2 low{std::numeric_limits<double>::infinity()};
    glm::dvec2 high{-std::numeric_limits<double>::infinity()};
    void add(const glm::dvec2& p);
    bool is_empty() const { return !(low.x <= high.x); }
    bool holds(const glm::dvec2& p) const {
      return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y;
    }
  };
  std::pair<std::size_t, std::size_t> find_square(const glm::dvec2& place) const;

  const PlaneLayer& layer_;
  std::vector<Box> boxes_;  // of each area
  Box whole_;
  std::size_t side_ = 1;                             // squares along a side of the grid
  std::vector<std::vector<std::uint32_t>> squares_;  // areas in the layer's order
};

}  // namespace nightcity::mesh
