// Latitude and longitude of a city's coordinates as polynomials, so that a reader of a scene needs
// no library for coordinate reference systems.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace nightcity {

/// Latitude and longitude (WGS 84, degrees) over a rectangle of a city's CRS, each the sum of
/// c[i * terms + j] T_i(u) T_j(v): T are Chebyshev's polynomials of the first kind, u and v run
/// from -1 to 1 over the rectangle's eastings and northings.
struct GeographicFit {
  glm::dvec2 low{0, 0}, high{0, 0};         // easting, northing
  std::size_t terms = 0;                    // along each axis, at least 2 and at most max_fit_terms
  std::vector<double> latitude, longitude;  // terms * terms coefficients each
};

constexpr std::size_t max_fit_terms = 16;

/// Returns what is wrong with a fit: "" where every place of its rectangle has a latitude and a
/// longitude, and none has those of another.
std::string describe_fault(const GeographicFit& fit);

/// Returns latitude and longitude in degrees; nothing outside the rectangle. The fit is sound.
std::optional<glm::dvec2> to_degrees(const GeographicFit& fit, const glm::dvec2& easting_northing);

/// Returns easting and northing; nothing where these lie outside the rectangle. The inverse of
/// to_degrees, by Newton's method.
std::optional<glm::dvec2> to_plane(const GeographicFit& fit, double latitude_deg,
                                   double longitude_deg);

}  // namespace nightcity
