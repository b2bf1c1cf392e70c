// Roads and the like that were published without heights (PLATEAU's roads in LoD1 lie at 0 m) and
// are put onto the terrain.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <span>

#include "formats/scratch_file.h"
#include "tools/bake/scene/tile_store.h"

namespace nightcity::bake {

/// Cuts a triangle at the middle of its longest edge until no edge is longer than `max_edge_m` in
/// plan, and passes each piece to `sink`. The rule depends on edges alone, so neighbours that share
/// an edge cut it at the same places, and no cracks open.
void subdivide(const glm::dvec3 (&corners)[3], double max_edge_m,
               const std::function<void(const glm::dvec3 (&)[3])>& sink);

/// Keeps objects without heights on disk until the terrain has been built.
class DrapeStore {
 public:
  explicit DrapeStore(const std::filesystem::path& path) : file_(path) {}

  void add(std::span<const TileStore::Triangle> triangles, std::uint32_t feature);
  /// Cuts the triangles fine enough to follow the ground and adds them to `tiles`, each vertex 0.1
  /// m above the ground. Where there is no ground a vertex keeps height 0. Returns the number of
  /// triangles that were added.
  std::size_t drape(const std::function<std::optional<double>(const glm::dvec2&)>& height_at,
                    TileStore& tiles);

 private:
  struct Record;
  ScratchFile file_;
};

}  // namespace nightcity::bake
