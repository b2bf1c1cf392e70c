// Finds which of a file's first two coordinates is east, which is north, and their signs.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>

#include "tools/georeference/source_crs.h"
#include "tools/georeference/srs_names.h"

namespace nightcity::georeference {

/// The map from a file's first two coordinates to east and north.
struct AxisOrder {
  bool swapped = false;  // the file holds north first
  double sign = 1;       // -1: the file holds west and south (old Krovak files)

  glm::dvec2 east_north(const glm::dvec3& c) const {
    return swapped ? glm::dvec2{sign * c.y, sign * c.x} : glm::dvec2{sign * c.x, sign * c.y};
  }
  /// "north, east": in the file's order.
  std::string in_words() const;
};

struct AxisChoice {
  std::unique_ptr<SourceCrs> crs;
  AxisOrder order;
  std::string why;          // the reason for this order, for the report
  bool doubtful = false;    // the file contradicts its CRS's name, or the way its surfaces face
  glm::dvec2 centre{0, 0};  // of the sample: longitude, latitude, degrees, of the CRS's own datum
  bool inside = false;      // the sample lies in the CRS's area of use (or there is no sample)
};

/// Returns the order that puts `sample` (coordinates as in the file) into the CRS's area of use. If
/// two orders do, a name that fixes the order is followed, whichever way rings are wound, unless
/// the right angles of buildings in degrees show the other order (right_angles.h). With other names
/// the rings decide (handedness.h), and where these say nothing, the name's promise.
AxisChoice choose_axis_order(std::unique_ptr<SourceCrs> crs, std::span<const glm::dvec3> sample,
                             AxisPromise given);

/// Returns the component-wise median of the finite points, which one broken coordinate does not
/// move; NaN where there are none.
glm::dvec2 find_median(std::span<const glm::dvec2> points);

}  // namespace nightcity::georeference
