// One frame for a city of many files, which may differ in their coordinate reference systems (CRS).
#pragma once

#include <cmath>
#include <cstddef>
#include <deque>
#include <glm/vec3.hpp>
#include <optional>
#include <shared_mutex>
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
  /// Returns the head of every file: those of the inputs' survey where there is one.
  static std::vector<city::CityHead> read_heads(const CityInputs& inputs);

  /// Returns the city's own frame.
  const georeference::CityFrame& city() const { return *city_; }
  /// Turns coordinates as they are in the input file of that number into E, N, H of the city, in
  /// place. Those of another CRS go through longitude and latitude; their heights stay.
  /// `anchor`: as in CityFrame::to_projected.
  void to_city(std::size_t file, std::span<glm::dvec3> coordinates,
               const std::optional<glm::dvec3>& anchor = {}) const;
  /// Returns the name by which the file of that number is placed, for ReadOptions::srs_name; none
  /// where a recipe's CRS or control points hold for all of it.
  std::optional<std::string> srs_name_of(std::size_t file) const;
  /// Returns the metres in the unit that the heights of that file have.
  double height_unit_of(std::size_t file) const;
  /// Returns whether a name that only some of a file's geometry has is known already.
  bool knows(const std::string& srs_name) const;
  /// Learns such a name from some coordinates of the geometry. `where` names file and object.
  /// Throws Error where the CRS is unknown, or the city's own is. Names must be learnt in file
  /// order: the first coordinates decide the order of axes where the name leaves it open.
  void learn(const std::string& srs_name, std::span<const glm::dvec3> sample,
             const std::string& where);
  /// As to_city above, for geometry of a name that is known.
  void to_city(const std::string& srs_name, std::span<glm::dvec3> coordinates,
               const std::optional<glm::dvec3>& anchor = {}) const;
  /// Returns a place in the middle of the first file's beginning: E, N, H, each the median.
  const glm::dvec3& reference() const { return reference_; }
  /// Sets the reference's height, where the files have none of their own; NaN changes nothing.
  void raise_reference(double height_m) {
    if (!std::isnan(height_m)) reference_.z = height_m;
  }
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
  const Foreign* find_foreign(const std::string& srs_name) const;
  Foreign make_foreign(const std::string& srs_name, std::span<const glm::dvec3> sample,
                       const std::string& where, const georeference::CityFrame::Options& options);
  void to_city(const Foreign* foreign, std::span<glm::dvec3> coordinates,
               const std::optional<glm::dvec3>& anchor) const;

  /// A deque, because a frame stays in use while others are learnt.
  std::deque<Foreign> foreign_;
  mutable std::shared_mutex mutex_;  // of the growth of foreign_
  std::string first_name_;           // that the city's own frame has
  std::vector<std::string> names_;   // of the files; empty: a recipe's CRS holds for all
  std::vector<const Foreign*> foreign_of_file_;  // null: the city's own
  glm::dvec3 reference_{0};
  void warn(const std::string& where, const georeference::CityFrame& frame);
  std::vector<std::string> descriptions_, warnings_;
};

}  // namespace nightcity::bake
