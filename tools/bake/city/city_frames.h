// One frame for a city of many files, which may differ in their coordinate reference systems.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/bake/recipe/recipe.h"
#include "tools/georeference/frame.h"

namespace nightcity {

class CityFrames {
 public:
  /// Looks at the head of every file. The first one with geometry gives the city its frame. Throws UsageError
  /// where the recipe names none, Error: a file that is missing or no CityGML, an unknown CRS, no geometry
  /// anywhere.
  explicit CityFrames(const Recipe& recipe);

  /// The city's own frame.
  const CityFrame& city() const { return *city_; }
  /// Coordinates as in file `file` of the recipe to E, N, H of the city, in place. A file in another CRS goes
  /// through longitude and latitude, its heights unchanged.
  void to_city(std::size_t file, std::span<glm::dvec3> coordinates) const;
  /// A place amid the first file's sample: E, N, H, each the median.
  const glm::dvec3& reference() const { return reference_; }
  /// One line for each CRS met, for the report.
  const std::vector<std::string>& descriptions() const { return descriptions_; }

 private:
  struct Foreign {
    std::string srs_name;
    CityFrame frame;
    bool same_crs;  // another name or axis order for the city's own CRS
  };
  std::optional<CityFrame> city_;
  std::vector<Foreign> foreign_;
  std::vector<std::optional<std::size_t>> foreign_of_file_;  // empty: the city's own
  glm::dvec3 reference_{0};
  std::vector<std::string> descriptions_;
};

}  // namespace nightcity
