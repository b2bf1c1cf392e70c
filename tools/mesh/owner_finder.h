// Areas of the plane in layers, and who owns a place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <limits>
#include <span>
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

/// Finds the owners of places in one layer. An area is listed in the squares of the grid that is
/// just wider than its box, at most four, so that areas as wide as the layer cost no more than
/// others.
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
  // A grid of `side` x `side` squares over the whole layer. Grids double their side.
  struct Grid {
    std::size_t side = 1;
    std::vector<std::vector<std::uint32_t>> squares{};  // areas in the layer's order
  };
  std::size_t find_column(const Grid& grid, const glm::dvec2& place, int axis) const;
  void add(std::uint32_t area, const Box& box);

  const PlaneLayer& layer_;
  std::vector<Box> boxes_;  // of each area
  Box whole_;
  std::vector<Grid> grids_;  // from one square on
};

}  // namespace nightcity::mesh
