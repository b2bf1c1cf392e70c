// The strongest lights of the cells of a light grid.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "runtime/scene/light_bins.h"
#include "shaders/interface.h"

namespace nightcity::scene {

/// A light and its strength, as one number that compares by strength: the bits of floats that are
/// not negative have their order.
using FoundLight = std::uint64_t;
inline FoundLight make_found(float strength, std::uint32_t light) {
  return std::uint64_t{std::bit_cast<std::uint32_t>(strength)} << 32 | (UINT32_MAX - light);
}
inline float strength_of(FoundLight found) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(found >> 32));
}
inline std::uint32_t light_of(FoundLight found) {
  return UINT32_MAX - static_cast<std::uint32_t>(found);
}

/// Finds the strongest lights of cells that lie in a row, and keeps its memory from cell to cell.
class StrongestLights {
 public:
  /// Finds `listed` lights a cell at most. Keeps `classes` and `shape`.
  StrongestLights(const std::vector<LightBins>& classes, const gpu::LightGridShape& shape,
                  std::size_t listed);

  /// Finds the lights that a cell lists, in no order.
  std::span<const FoundLight> find(std::uint32_t x, std::uint32_t z);

  /// Returns the strength of the weakest light that the last cell lists, if it lists any.
  float weakest() const { return weakest_; }
  /// Returns the strength of the strongest light that the last cell does not list, or more.
  float outside() const { return outside_; }

 private:
  bool find_stronger(float x, float z);
  void add_stronger(const LightRange& range, float centre_x, float centre_z);
  void leave_gap();

  const std::vector<LightBins>& classes_;
  const gpu::LightGridShape& shape_;
  std::size_t listed_;
  std::vector<FoundLight> found_;  // the first count_ of these, and room for more
  std::size_t count_ = 0;
  float bar_ = 0, unseen_ = 0, weakest_ = 0, outside_ = 0;
};

/// Returns the place of a cell's centre, X and Z.
std::pair<float, float> find_cell_centre(const gpu::LightGridShape& shape, std::uint32_t x,
                                         std::uint32_t z);

}  // namespace nightcity::scene
