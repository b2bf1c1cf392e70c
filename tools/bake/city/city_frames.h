// One frame for a city of many files, which may differ in their coordinate reference systems (CRS).
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/bake/city/city_inputs.h"
#include "tools/city/city_reader.h"
#include "tools/georeference/frame.h"

namespace nightcity::bake {

class CityFrames {
 public:
  /// Reads the head of every file. The first one with geometry gives the city its frame. Throws
  /// UsageError where the inputs name no file; Error where a file is missing or no city model, a
  /// CRS is unknown or no file has geometry.
  explicit CityFrames(const CityInputs& inputs);

  /// Returns the city's own frame.
  const georeference::CityFrame& city() const { return *city_; }
  /// Turns coordinates as they are in the input file of that number into E, N, H of the city, in
  /// place. Those of another CRS go through longitude and latitude; their heights stay.
  void to_city(std::size_t file, std::span<glm::dvec3> coordinates) const;
  /// Returns a place in the middle of the first file's beginning: E, N, H, each the median.
  const glm::dvec3& reference() const { return reference_; }
  /// Returns one line for each CRS of the files, for the report.
  const std::vector<std::string>& descriptions() const { return descriptions_; }
  /// Returns a warning for each CRS whose axis order is doubtful.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  struct Foreign {
    std::string srs_name;
    georeference::CityFrame frame;
    bool same_crs;  // another name or axis order for the city's own CRS
  };
  void add_foreign(const CityInputs& inputs, const std::vector<city::CityHead>& heads,
                   std::size_t first, const georeference::CityFrame::Options& options);

  std::optional<georeference::CityFrame> city_;
  std::vector<Foreign> foreign_;
  std::vector<std::optional<std::size_t>> foreign_of_file_;  // empty: the city's own
  glm::dvec3 reference_{0};
  void warn(const std::filesystem::path& file, const georeference::CityFrame& frame);
  std::vector<std::string> descriptions_, warnings_;
};

}  // namespace nightcity::bake
