// The content of one tile: a glTF of what stands in it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "formats/light_file.h"
#include "formats/scene.h"
#include "tools/exports/tileset.h"

namespace nightcity::exports {

/// A box in model space.
struct ModelBox {
  glm::dvec3 least{std::numeric_limits<double>::infinity()}, greatest{-least};
  void add(const glm::dvec3& p);
};

/// The things that stand in a tile, by their numbers in the scene and the light file.
struct TileParts {
  struct Part {
    std::size_t node, instance;
  };
  std::vector<Part> parts;
  std::vector<std::size_t> lamps;
  ModelBox box;
};

/// Writes the tile with its origin at `origin` (model space) and adds its figures to `report`.
void write_tile(const Scene& scene, const LightFile* lights, const TileParts& tile,
                const glm::dvec3& origin, const std::filesystem::path& path,
                const TilesetOptions& options, TilesetReport& report);

}  // namespace nightcity::exports
