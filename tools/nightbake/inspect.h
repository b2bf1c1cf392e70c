// Describes the content of a file as JSON. Every kind of file has the keys kind,
// buildings, polygons, triangles, lights, crs, bbox and skipped (null or empty where they
// mean nothing), then its own.
#pragma once

#include <filesystem>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

namespace nightcity::nightbake {

using Inspection = nlohmann::ordered_json;

/// These throw Error as the readers of the files do.
/// `kind`: the name of the city format in lower case ("citygml", "cityjson").
Inspection inspect_city(const std::filesystem::path& file, const std::string& kind, int max_lod);
Inspection inspect_osm(const std::filesystem::path& file);
Inspection inspect_scene(const std::filesystem::path& file);
Inspection inspect_lights(const std::filesystem::path& file);
Inspection inspect_luminaire(const std::filesystem::path& file);

/// Returns the common keys, in their order and without values.
Inspection make_empty_inspection(const std::string& kind);

struct Bounds {
  glm::dvec3 min{std::numeric_limits<double>::infinity()},
      max{-std::numeric_limits<double>::infinity()};
  void add(const glm::dvec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  /// Returns [x0, y0, z0, x1, y1, z1], in two dimensions [x0, y0, x1, y1], which is GeoJSON's
  /// order; null where nothing was added.
  Inspection to_json(int dimensions) const;
};

}  // namespace nightcity::nightbake
