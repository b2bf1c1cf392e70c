#include "formats/geographic_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

namespace nightcity {
namespace {

// Metres in a degree of latitude: a minute is a nautical mile, within 1 %.
constexpr double degree_m = 60 * 1852;

// Chebyshev's polynomials at a place, and their derivatives.
struct Basis {
  std::array<double, max_fit_terms> value{}, slope{};

  Basis(double x, std::size_t terms) {
    value[0] = 1;
    value[1] = x;
    slope[1] = 1;
    for (std::size_t i = 2; i < terms; ++i) {
      value[i] = 2 * x * value[i - 1] - value[i - 2];
      slope[i] = 2 * value[i - 1] + 2 * x * slope[i - 1] - slope[i - 2];
    }
  }
};

struct Sum {
  double value = 0;
  glm::dvec2 slope{0, 0};  // along u and v
};

Sum add_up(const std::vector<double>& coefficients, std::size_t terms, const Basis& u,
           const Basis& v) {
  Sum sum;
  for (std::size_t i = 0; i < terms; ++i)
    for (std::size_t j = 0; j < terms; ++j) {
      const double c = coefficients[i * terms + j];
      sum.value += c * u.value[i] * v.value[j];
      sum.slope += c * glm::dvec2(u.slope[i] * v.value[j], u.value[i] * v.slope[j]);
    }
  return sum;
}

struct Degrees {
  Sum latitude, longitude;

  Degrees(const GeographicFit& fit, const glm::dvec2& uv) {
    const Basis u(uv.x, fit.terms), v(uv.y, fit.terms);
    latitude = add_up(fit.latitude, fit.terms, u, v);
    longitude = add_up(fit.longitude, fit.terms, u, v);
  }
  // The determinant of the derivatives: above 0 where longitude grows to the east and latitude to
  // the north.
  double determinant() const {
    return longitude.slope.x * latitude.slope.y - longitude.slope.y * latitude.slope.x;
  }
};

bool is_inside(const glm::dvec2& uv) {
  constexpr double rounding = 1e-9;
  return std::abs(uv.x) <= 1 + rounding && std::abs(uv.y) <= 1 + rounding;
}

std::string describe_size(const GeographicFit& fit) {
  constexpr double max_coordinate = 1e9;
  for (int axis = 0; axis < 2; ++axis)
    if (!(std::abs(fit.low[axis]) <= max_coordinate) ||
        !(std::abs(fit.high[axis]) <= max_coordinate) || !(fit.low[axis] < fit.high[axis]))
      return "the rectangle has no size, or a corner beyond 1e9 m";
  if (fit.terms < 2 || fit.terms > max_fit_terms)
    return "there are " + std::to_string(fit.terms) + " terms along an axis, not 2 to " +
           std::to_string(max_fit_terms);
  const std::size_t count = fit.terms * fit.terms;
  if (fit.latitude.size() != count || fit.longitude.size() != count)
    return "latitude and longitude have not as many coefficients as there are terms";
  const auto is_angle = [](double c) { return std::abs(c) <= 360; };
  if (!std::all_of(fit.latitude.begin(), fit.latitude.end(), is_angle) ||
      !std::all_of(fit.longitude.begin(), fit.longitude.end(), is_angle))
    return "a coefficient is no angle in degrees";
  return {};
}

}  // namespace

std::string describe_fault(const GeographicFit& fit) {
  if (std::string fault = describe_size(fit); !fault.empty()) return fault;
  // The unit of a city's plane is a metre, or that of a model that names no CRS.
  constexpr double min_unit_m = 1e-3, max_unit_m = 1e3;
  constexpr int steps = 8;
  const glm::dvec2 half = 0.5 * (fit.high - fit.low);
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const Degrees at(fit, {2.0 * i / steps - 1, 2.0 * j / steps - 1});
      const double latitude = at.latitude.value;
      if (!(std::abs(latitude) < 90)) return "a latitude is not between -90 and 90 degrees";
      const double unit_m2 = at.determinant() * degree_m * degree_m *
                             std::cos(latitude * 3.14159265358979 / 180) / (half.x * half.y);
      if (!(unit_m2 >= min_unit_m * min_unit_m) || !(unit_m2 <= max_unit_m * max_unit_m))
        return "latitude and longitude do not belong to one place alone";
    }
  return {};
}

std::optional<glm::dvec2> to_degrees(const GeographicFit& fit, const glm::dvec2& easting_northing) {
  const glm::dvec2 uv = (2.0 * easting_northing - fit.low - fit.high) / (fit.high - fit.low);
  if (!is_inside(uv)) return std::nullopt;
  const Degrees at(fit, uv);
  return glm::dvec2(at.latitude.value, std::remainder(at.longitude.value, 360));
}

std::optional<glm::dvec2> to_plane(const GeographicFit& fit, double latitude_deg,
                                   double longitude_deg) {
  constexpr int max_steps = 30;
  constexpr double found_deg = 1e-10;  // 0.01 mm
  if (!std::isfinite(latitude_deg) || !std::isfinite(longitude_deg)) return std::nullopt;
  glm::dvec2 uv(0);
  for (int step = 0; step < max_steps; ++step) {
    const Degrees at(fit, uv);
    const double north = latitude_deg - at.latitude.value;
    const double east = std::remainder(longitude_deg - at.longitude.value, 360);
    if (std::abs(north) <= found_deg && std::abs(east) <= found_deg) {
      if (!is_inside(uv)) return std::nullopt;
      return 0.5 * (fit.low + fit.high + uv * (fit.high - fit.low));
    }
    const double determinant = at.determinant();
    if (!(determinant > 0)) return std::nullopt;
    uv += glm::dvec2(east * at.latitude.slope.y - north * at.longitude.slope.y,
                     north * at.longitude.slope.x - east * at.latitude.slope.x) /
          determinant;
    uv = glm::clamp(uv, -1.5, 1.5);  // far outside, polynomials say nothing
  }
  return std::nullopt;
}

}  // namespace nightcity
