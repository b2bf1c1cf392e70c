#include "runtime/viewer/map_projection.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace nightcity::viewer {
namespace {

using GeographicLib::TransverseMercator;

// Farther off the meridian a grid is of no use, and the inverse may not converge.
constexpr double max_degrees_off_meridian = 20;

// WGS 84's ellipsoid, which that of GRS 80 equals within a tenth of a millimetre.
constexpr double equatorial_m = 6378137, flattening = 1 / 298.257223563;

// Latitude and longitude of the origins of Japan's plane zones I to XIX (Geospatial Information
// Authority of Japan), degrees.
constexpr std::array<glm::dvec2, 19> japan{{{33, 129.5},
                                            {33, 131},
                                            {36, 132 + 10 / 60.0},
                                            {33, 133.5},
                                            {36, 134 + 20 / 60.0},
                                            {36, 136},
                                            {36, 137 + 10 / 60.0},
                                            {36, 138.5},
                                            {36, 139 + 50 / 60.0},
                                            {40, 140 + 50 / 60.0},
                                            {44, 140.25},
                                            {44, 142.25},
                                            {44, 144.25},
                                            {26, 142},
                                            {26, 127.5},
                                            {26, 124},
                                            {26, 131},
                                            {20, 136},
                                            {26, 154}}};

// Returns the northing of a latitude on the meridian, m.
double northing_of(const TransverseMercator& mercator, double latitude_deg) {
  double x = 0, y = 0;
  mercator.Forward(0, latitude_deg, 0, x, y);
  return y;
}

std::optional<int> parse_epsg(std::string_view crs) {
  constexpr std::string_view prefix = "EPSG:";
  if (!crs.starts_with(prefix)) return std::nullopt;
  crs.remove_prefix(prefix.size());
  int code = 0;
  const auto [end, error] = std::from_chars(crs.data(), crs.data() + crs.size(), code);
  if (error != std::errc() || end != crs.data() + crs.size()) return std::nullopt;
  return code;
}

}  // namespace

MapProjection::MapProjection(const std::string& crs, const std::optional<GeographicFit>& fit)
    : fit_(fit) {
  if (fit_) return;
  if (const auto code = parse_epsg(crs)) {
    const int zone = *code % 100, family = *code / 100;
    const bool is_utm = ((family == 326 || family == 327) && zone >= 1 && zone <= 60) ||
                        (family == 258 && zone >= 28 && zone <= 38);
    if (is_utm)
      grid_ = Grid{TransverseMercator(equatorial_m, flattening, 0.9996),
                   6.0 * zone - 183,
                   {500'000, family == 327 ? 10'000'000 : 0}};
    if (*code >= 6669 && *code <= 6687) {
      const glm::dvec2 origin = japan[static_cast<std::size_t>(*code - 6669)];
      const TransverseMercator mercator(equatorial_m, flattening, 0.9999);
      grid_ = Grid{mercator, origin.y, {0, -northing_of(mercator, origin.x)}};
    }
    return;
  }
  // As nightbake writes it (tools/georeference/local_mercator.cpp).
  double latitude = 0, longitude = 0, a = 0, rf = 0;
  if (std::sscanf(crs.c_str(),
                  "+proj=tmerc +lat_0=%lf +lon_0=%lf +k=1 +x_0=0 +y_0=0 +a=%lf +rf=%lf", &latitude,
                  &longitude, &a, &rf) == 4 &&
      std::abs(latitude) <= 90 && std::abs(longitude) <= 360 && a > 1e6 && a < 1e7 && rf > 100) {
    const TransverseMercator mercator(a, 1 / rf, 1);
    grid_ = Grid{mercator, longitude, {0, -northing_of(mercator, latitude)}};
  }
}

std::optional<glm::dvec2> MapProjection::to_plane(double latitude_deg, double longitude_deg) const {
  if (fit_) return nightcity::to_plane(*fit_, latitude_deg, longitude_deg);
  if (!grid_ || !(std::abs(latitude_deg) <= 90) ||
      !(std::abs(std::remainder(longitude_deg - grid_->meridian_deg, 360)) <=
        max_degrees_off_meridian))
    return std::nullopt;
  glm::dvec2 plane;
  grid_->mercator.Forward(grid_->meridian_deg, latitude_deg, longitude_deg, plane.x, plane.y);
  return plane + grid_->shift;
}

std::optional<glm::dvec2> MapProjection::to_degrees(const glm::dvec2& easting_northing) const {
  constexpr double max_easting_m = 2e6, max_northing_m = 1e7;
  if (fit_) return nightcity::to_degrees(*fit_, easting_northing);
  if (!grid_) return std::nullopt;
  const glm::dvec2 plane = easting_northing - grid_->shift;
  if (!(std::abs(plane.x) <= max_easting_m) || !(std::abs(plane.y) <= max_northing_m))
    return std::nullopt;
  glm::dvec2 degrees;
  grid_->mercator.Reverse(grid_->meridian_deg, plane.x, plane.y, degrees.x, degrees.y);
  return degrees;
}

}  // namespace nightcity::viewer
