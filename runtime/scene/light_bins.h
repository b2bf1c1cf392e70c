// The lights of a map by the squares that they lie in, in classes of flux: what lists of the
// strongest lights are found from.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "formats/light.h"
#include "shaders/interface.h"

namespace nightcity::scene {

/// Lights in the order of their bins, each property in an array of its own, so that four at a time
/// are looked at.
struct LightRange {
  const float *x, *z, *flux;
  const std::uint32_t* light;
  std::size_t count;
};

/// The lights of one class, sorted into square bins of the map.
class LightBins {
 public:
  /// `members`: indices of the lights. Keeps `shape`.
  LightBins(std::span<const Light> lights, std::span<const float> flux_lm,
            std::vector<std::uint32_t> members, const gpu::LightGridShape& shape, float side_m);

  int column(float x) const { return place(x - shape_.origin_x, width_); }
  int row(float z) const { return place(z - shape_.origin_z, depth_); }
  float max_reach_m() const { return reach_bins * side_m_; }

  /// Returns an upper bound of a light's strength at this distance from the centre of a cell.
  float max_strength(float distance_m) const {
    return max_flux_ / (distance_m * distance_m + shape_.softening_m2);
  }

  /// Returns a distance from the centre of a cell beyond which no light is stronger than `bar`
  /// there. It is negative where no light is.
  float find_reach(float bar) const {
    constexpr float rounding = 1.001f;
    const float squared = rounding * max_flux_ / bar - shape_.softening_m2;
    return squared < 0 ? -1.0f : rounding * std::sqrt(squared);
  }

  /// Calls `use` with ranges of lights, among which are all within `reach_m` of (x, z).
  template <class Use>
  void for_each_near(float x, float z, float reach_m, Use use) const {
    const int end = row(z + reach_m);
    for (int bz = row(z - reach_m); bz <= end; ++bz) {
      // The rows' lights are at least this far along Z. The place of a light in a bin was rounded.
      const float lower = shape_.origin_z + float(bz) * side_m_,
                  away = std::max({lower - z, z - (lower + side_m_), 0.0f}) - 1e-3f * side_m_;
      const float half = std::sqrt(std::max(0.0f, reach_m * reach_m - away * std::abs(away)));
      const std::size_t first = std::size_t(bz) * std::size_t(width_),
                        from = starts_[first + std::size_t(column(x - half))],
                        to = starts_[first + std::size_t(column(x + half)) + 1];
      if (from < to) use(LightRange{&x_[from], &z_[from], &flux_[from], &order_[from], to - from});
    }
  }

 private:
  // The radius of the search for lights around a cell, in bins of their class.
  static constexpr float reach_bins = 24;

  int place(float along, int count) const {
    return int(std::clamp(along / side_m_, 0.0f, float(count - 1)));
  }

  const gpu::LightGridShape& shape_;
  float side_m_;
  int width_, depth_;
  std::vector<std::uint32_t> starts_, order_;
  std::vector<float> x_, z_, flux_;  // of the lights, in the order of order_
  float max_flux_ = 0;
};

/// Returns all lights that shine, class by class. The bins keep `shape`.
std::vector<LightBins> sort_into_bins(std::span<const Light> lights, std::span<const float> flux_lm,
                                      const gpu::LightGridShape& shape);

}  // namespace nightcity::scene
