// Latitude and longitude of a city's extent as polynomials, for programs without PROJ.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <optional>

#include "formats/geographic_fit.h"

namespace nightcity::georeference {

/// A fit is made with as few terms as keep it within `good_fit_m` of the truth, and none is made
/// that is off by more than `max_fit_m`.
constexpr double good_fit_m = 0.01, max_fit_m = 0.1;

struct DegreesFit {
  std::optional<GeographicFit> fit;  // nothing where none is within max_fit_m
  double error_m = 0;  // the greatest at 33 x 33 places, of `fit` or of the best that was tried
};

/// Fits `to_lon_lat` (easting, northing to WGS 84 degrees) over the rectangle from `low` to `high`,
/// widened on each side by half its longer side and 1 km, so that a camera beside the city has a
/// latitude as well; or not widened, where `to_lon_lat` has no answer (NaN) out there.
DegreesFit fit_degrees(const std::function<glm::dvec2(const glm::dvec2&)>& to_lon_lat,
                       const glm::dvec2& low, const glm::dvec2& high);

}  // namespace nightcity::georeference
