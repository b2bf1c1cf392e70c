// What a file holds, as JSON. Every kind has the keys kind, buildings, polygons, triangles, lights, crs,
// bbox, skipped (null or empty where they mean nothing), then its own.
#pragma once

#include <filesystem>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <nlohmann/json.hpp>

namespace nightcity {

using Inspection = nlohmann::ordered_json;

/// All throw Error as the readers of these files do.
Inspection inspect_citygml(const std::filesystem::path& file, int highest_lod);
Inspection inspect_osm(const std::filesystem::path& file);
Inspection inspect_scene(const std::filesystem::path& file);
Inspection inspect_lights(const std::filesystem::path& file);
Inspection inspect_luminaire(const std::filesystem::path& file);

/// The common keys, in their order, empty.
Inspection empty_inspection(const char* kind);

struct Bounds {
  glm::dvec3 least{std::numeric_limits<double>::infinity()},
      greatest{-std::numeric_limits<double>::infinity()};
  void add(const glm::dvec3& p) {
    least = glm::min(least, p);
    greatest = glm::max(greatest, p);
  }
  /// [x0, y0, z0, x1, y1, z1] (2 dimensions: four numbers), as GeoJSON orders them; null where nothing was
  /// added.
  Inspection json(int dimensions) const;
};

}  // namespace nightcity
