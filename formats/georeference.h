// The place of a scene on the Earth. Both output files store it, and it is the same in both.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace nightcity {

/// Model space is in metres from `origin`, as floats:
/// X = easting - origin.x, Y = height - origin.z, Z = -(northing - origin.y).
struct Georeference {
  std::string crs;                    // "EPSG:25833", a PROJ string, or "" if the city has none
  glm::dvec3 origin{0, 0, 0};         // easting, northing, height in that CRS, m
  std::vector<std::string> sources;   // input files, without their folders
  std::vector<std::string> licences;  // e.g. "OpenStreetMap contributors, ODbL 1.0"
  // The same in both files of a bake (scene_identity.h); "" is not checked.
  std::string scene_id{};

  /// Returns the model-space position of (easting, northing, height) in the CRS. In double, because
  /// these coordinates are too large for floats.
  glm::dvec3 to_model(const glm::dvec3& enh) const {
    return {enh.x - origin.x, enh.z - origin.z, -(enh.y - origin.y)};
  }
  /// The inverse of to_model.
  glm::dvec3 from_model(const glm::dvec3& xyz) const {
    return {xyz.x + origin.x, -xyz.z + origin.y, xyz.y + origin.z};
  }
};

}  // namespace nightcity
