#include "tools/exports/place_on_earth.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "formats/error.h"

namespace nightcity::exports {
namespace {

georeference::CityFrame make_frame(const std::string& crs, const glm::dvec3& place) {
  if (crs.empty())
    throw Error("",
                "the scene has no CRS, so its place on the Earth is unknown: bake it with "
                "[city] crs, bounds or control_points");
  return georeference::CityFrame::from_srs_name(crs, {&place, 1}, {});
}

}  // namespace

// WGS 84: EPSG's ellipsoid 7030.
glm::dvec3 to_ecef(const glm::dvec2& lon_lat, double height_m) {
  constexpr double semi_major_m = 6'378'137.0, flattening = 1 / 298.257223563;
  constexpr double eccentricity2 = flattening * (2 - flattening);
  const double lon = glm::radians(lon_lat.x), lat = glm::radians(lon_lat.y);
  const double sine = std::sin(lat), cosine = std::cos(lat);
  const double normal = semi_major_m / std::sqrt(1 - eccentricity2 * sine * sine);
  return {(normal + height_m) * cosine * std::cos(lon),
          (normal + height_m) * cosine * std::sin(lon),
          (normal * (1 - eccentricity2) + height_m) * sine};
}

PlaceOnEarth::PlaceOnEarth(const std::string& crs, const glm::dvec3& place, double geoid_m)
    : frame_(make_frame(crs, place)), geoid_m_(geoid_m) {}

glm::dvec2 PlaceOnEarth::to_lon_lat(const glm::dvec2& east_north) const {
  return frame_.to_lon_lat(east_north);
}

std::array<double, 16> PlaceOnEarth::make_transform(const glm::dvec3& place) const {
  const double height = to_ellipsoid(place.z);
  const auto on_earth = [&](const glm::dvec2& offset) {
    return to_ecef(to_lon_lat(glm::dvec2(place) + offset), height);
  };
  constexpr double step_m = 50;
  const glm::dvec3 origin = on_earth({0, 0});
  const glm::dvec3 east = (on_earth({step_m, 0}) - on_earth({-step_m, 0})) / (2 * step_m);
  const glm::dvec2 lon_lat = to_lon_lat(glm::dvec2(place));
  const double lon = glm::radians(lon_lat.x), lat = glm::radians(lon_lat.y);
  const glm::dvec3 up(std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat));
  const double scale = glm::length(east);
  // Grids are conformal, so north is at a right angle to east and as long.
  const glm::dvec3 x = glm::normalize(east - up * glm::dot(east, up)) * scale;
  const glm::dvec3 y = glm::cross(up, x);
  return {x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, up.x, up.y, up.z, 0, origin.x, origin.y, origin.z, 1};
}

}  // namespace nightcity::exports
