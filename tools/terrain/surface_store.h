// Triangles under a vertical ray, for models larger than memory: sorted into square cells of a scratch file,
// fetched again cell by cell as rays ask for them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "formats/atomic_file.h"

namespace nightcity {

/// Coordinates E, N, H in metres, any magnitude. Memory: a hundred bytes a cell (64 m wide, coarser where
/// triangles are larger), and a fixed amount for triangles not yet written and for cells lately asked for.
class SurfaceStore {
 public:
  /// Scratch file beside `path`.
  explicit SurfaceStore(const std::filesystem::path& path) : file_(path) {}

  /// False, and left out, for nobody stands on them: vertical, degenerate and non-finite triangles.
  bool add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);
  bool empty() const { return count_ == 0; }

  /// The greatest height of a triangle on the vertical line through `p`; a point on an edge belongs to both
  /// sides. Safe to call from many threads once nothing is added any more.
  std::optional<double> highest_at(const glm::dvec2& p);

 private:
  struct Triangle {
    glm::dvec3 corners[3];  // relative to origin_
  };
  struct CellKey {
    std::int32_t level, column, row;
    auto operator<=>(const CellKey&) const = default;
  };
  struct Cell {
    std::vector<Triangle> pending;
    std::uint64_t last_record = 0;  // offset + 1; each record names the one before it
    std::uint32_t stored = 0;
  };
  struct Record;
  struct Loaded;

  static double cell_size(int level);
  void flush();
  void forget_older_half();
  std::shared_ptr<const Loaded> load(const CellKey& key, const Cell& cell);

  static constexpr int levels = 24;  // the coarsest cells are wider than any frame
  ScratchFile file_;
  std::optional<glm::dvec2> origin_;
  std::map<CellKey, Cell> cells_;
  std::array<bool, levels> used_{};
  std::size_t count_ = 0, pending_ = 0;

  std::mutex mutex_;  // of what follows, and of pending triangles written late
  std::map<CellKey, std::pair<std::shared_ptr<const Loaded>, std::uint64_t>> cache_;  // with its last use
  std::size_t cached_cost_ = 0;                                                       // in triangles
  std::uint64_t clock_ = 0;
};

}  // namespace nightcity
