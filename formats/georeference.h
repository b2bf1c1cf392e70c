// Where a scene stands on the Earth: stored in both output files, the same in each.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace nightcity {

/// Model space is float metres from `origin`: X = easting - origin.x, Y = height - origin.z, Z = -(northing -
/// origin.y).
struct Georeference {
  std::string crs;                    // "EPSG:25833", a PROJ string, or "" where the city has none
  glm::dvec3 origin{0, 0, 0};         // easting, northing, height in that CRS, m
  std::vector<std::string> sources;   // input files, names only
  std::vector<std::string> licences;  // e.g. "OpenStreetMap contributors, ODbL 1.0"

  /// (easting, northing, height) in the CRS to model space. Double in, so that the subtraction loses nothing.
  glm::dvec3 to_model(const glm::dvec3& enh) const {
    return {enh.x - origin.x, enh.z - origin.z, -(enh.y - origin.y)};
  }
  glm::dvec3 from_model(const glm::dvec3& xyz) const {
    return {xyz.x + origin.x, -xyz.z + origin.y, xyz.y + origin.z};
  }
};

}  // namespace nightcity
