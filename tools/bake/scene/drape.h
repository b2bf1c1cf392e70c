// Roads and the like that were published without heights (PLATEAU's LoD1 roads lie at 0 m): laid onto the
// terrain.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <span>

#include "formats/atomic_file.h"
#include "tools/bake/scene/tile_store.h"
#include "tools/city/city_model.h"

namespace nightcity {

/// Whether `object` is of a kind that lies on the ground and every vertex of it has height 0 exactly, as in
/// the file.
bool lacks_heights(const CityObject& object);

/// Cuts a triangle at the middle of its longest edge until no edge is longer than `longest_m` in plan. The
/// rule looks at edges alone, so neighbours that share an edge cut it at the same places and no cracks open.
void subdivide(const glm::dvec3 (&corners)[3], double longest_m,
               const std::function<void(const glm::dvec3 (&)[3])>& sink);

/// Keeps such objects on disk until the terrain is known.
class DrapeStore {
 public:
  explicit DrapeStore(const std::filesystem::path& path) : file_(path) {}

  void add(std::span<const TileStore::Triangle> triangles, std::uint32_t feature);
  /// Cuts the triangles fine enough to follow the ground and hands them to `tiles`, each vertex a hand's
  /// breadth above it. Where there is no ground a vertex keeps height 0. Returns how many triangles were
  /// laid.
  std::size_t lay(const std::function<std::optional<double>(const glm::dvec2&)>& height_at,
                  TileStore& tiles);

 private:
  struct Record;
  ScratchFile file_;
};

}  // namespace nightcity
