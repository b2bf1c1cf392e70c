// Finds triangles on vertical lines, in models larger than memory: they are sorted into square
// cells of a scratch file and read again cell by cell when lines need them.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "tools/cell_cache.h"
#include "tools/cell_file.h"

namespace nightcity::terrain {

/// A rectangle of the plan: E, N, m.
struct Extent {
  glm::dvec2 low, high;
};

/// Coordinates E, N, H in metres, of any magnitude. Memory: some thirty bytes per cell (128 m wide,
/// wider where triangles are larger), and some fifteen megabytes at most for triangles not yet
/// written and cells used recently.
class SurfaceStore {
 public:
  /// Scratch file beside `path`.
  explicit SurfaceStore(const std::filesystem::path& path);
  ~SurfaceStore();

  /// Adds a triangle. Returns false for vertical, degenerate and non-finite ones, which are left
  /// out: nothing can stand on them.
  bool add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);
  bool empty() const { return count_ == 0; }
  /// Returns the rectangle of the plan that holds all triangles; none where there is none.
  std::optional<Extent> extent() const { return extent_; }

  /// Returns the greatest height of a triangle on the vertical line through `p`; a point on an edge
  /// belongs to both sides. May be called from many threads while no triangle is added.
  std::optional<double> highest_at(const glm::dvec2& p);
  /// Returns at how many triangles highest_at() looks.
  std::size_t count_candidates(const glm::dvec2& p);

 private:
  struct Triangle {
    glm::dvec3 corners[3];  // relative to origin_
  };
  struct CellKey {
    std::int32_t level, column, row;
    auto operator<=>(const CellKey&) const = default;
  };
  struct Loaded;

  static double cell_size(int level);
  /// Calls visit(cell, place in it) for each cell that holds `p`.
  template <class Visit>
  void for_each_cell(const glm::dvec2& p, const Visit& visit);

  static constexpr int levels = 24;  // the coarsest cells are wider than any frame
  std::optional<glm::dvec2> origin_;
  std::array<bool, levels> used_{};
  std::size_t count_ = 0;
  std::optional<Extent> extent_;
  CellFile<CellKey, Triangle> cells_;
  std::unique_ptr<CellCache<CellKey, Loaded>> cache_;
};

}  // namespace nightcity::terrain
