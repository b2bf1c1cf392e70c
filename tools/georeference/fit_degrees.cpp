#include "tools/georeference/fit_degrees.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace nightcity::georeference {
namespace {

using ToLonLat = std::function<glm::dvec2(const glm::dvec2&)>;

constexpr double half_turn = 3.14159265358979323846;
constexpr double infinity = std::numeric_limits<double>::infinity();

// The places at which fits are compared with the truth.
constexpr std::size_t checks_along_an_axis = 33;

// Returns the point at u, v from -1 to 1.
glm::dvec2 find_point(const GeographicFit& fit, double u, double v) {
  return 0.5 * (fit.low + fit.high + glm::dvec2(u, v) * (fit.high - fit.low));
}

// A place and its truth, which crosses no date line within a city.
struct Sample {
  glm::dvec2 plane, lon_lat;
};

class Fitter {
 public:
  Fitter(const ToLonLat& to_lon_lat, const glm::dvec2& low, const glm::dvec2& high)
      : to_lon_lat_(to_lon_lat) {
    domain_.low = low;
    domain_.high = high;
    middle_ = to_lon_lat(0.5 * (low + high));
    const double steps = checks_along_an_axis - 1;
    for (std::size_t i = 0; i < checks_along_an_axis; ++i)
      for (std::size_t j = 0; j < checks_along_an_axis; ++j) {
        const glm::dvec2 at =
            find_point(domain_, 2 * double(i) / steps - 1, 2 * double(j) / steps - 1);
        checks_.push_back({at, look_up(at)});
      }
  }

  DegreesFit find_best() const {
    DegreesFit best{std::nullopt, infinity};
    for (std::size_t terms = 3; terms <= max_fit_terms && !(best.error_m <= good_fit_m); ++terms) {
      GeographicFit fit = interpolate(terms);
      if (const double error_m = find_error_m(fit); error_m < best.error_m)
        best = {std::move(fit), error_m};
    }
    if (!(best.error_m <= max_fit_m)) best.fit.reset();
    return best;
  }

 private:
  glm::dvec2 look_up(const glm::dvec2& plane) const {
    glm::dvec2 lon_lat = to_lon_lat_(plane);
    lon_lat.x = middle_.x + std::remainder(lon_lat.x - middle_.x, 360);
    return lon_lat;
  }

  // Interpolates at the zeros of the first Chebyshev polynomial that is left out (Mason and
  // Handscomb, Chebyshev Polynomials, 2003, equation 6.28), along both axes.
  GeographicFit interpolate(std::size_t terms) const {
    const auto angle_of = [&](std::size_t k) {
      return half_turn * (double(k) + 0.5) / double(terms);
    };
    GeographicFit fit = domain_;
    fit.terms = terms;
    std::vector<glm::dvec2> values;
    for (std::size_t k = 0; k < terms; ++k)
      for (std::size_t l = 0; l < terms; ++l)
        values.push_back(look_up(find_point(fit, std::cos(angle_of(k)), std::cos(angle_of(l)))));
    for (std::size_t i = 0; i < terms; ++i)
      for (std::size_t j = 0; j < terms; ++j) {
        glm::dvec2 sum(0);
        for (std::size_t k = 0; k < terms; ++k)
          for (std::size_t l = 0; l < terms; ++l)
            sum += values[k * terms + l] * std::cos(double(i) * angle_of(k)) *
                   std::cos(double(j) * angle_of(l));
        sum *= (i == 0 ? 1.0 : 2.0) * (j == 0 ? 1.0 : 2.0) / double(terms * terms);
        fit.longitude.push_back(round_off(sum.x));
        fit.latitude.push_back(round_off(sum.y));
      }
    return fit;
  }

  // A coefficient rounded to 1e-11 degrees is off by less than a micrometre, and short as text. Adding
  // 0 leaves no -0.
  static double round_off(double degrees) { return std::round(degrees * 1e11) / 1e11 + 0.0; }

  double find_error_m(const GeographicFit& fit) const {
    if (!describe_fault(fit).empty()) return infinity;
    constexpr double degree_m = 111'320;  // of latitude, and of longitude at the equator, to 1 %
    double worst_m = 0;
    for (const Sample& check : checks_) {
      const auto found = to_degrees(fit, check.plane);
      if (!found) return infinity;
      const double north = found->x - check.lon_lat.y;
      const double east = std::remainder(found->y - check.lon_lat.x, 360) *
                          std::cos(check.lon_lat.y * half_turn / 180);
      const double error_m = degree_m * std::hypot(north, east);
      if (!std::isfinite(error_m)) return infinity;
      worst_m = std::max(worst_m, error_m);
    }
    return worst_m;
  }

  const ToLonLat& to_lon_lat_;
  GeographicFit domain_;  // the rectangle alone
  glm::dvec2 middle_{0};
  std::vector<Sample> checks_;
};

}  // namespace

DegreesFit fit_degrees(const ToLonLat& to_lon_lat, const glm::dvec2& low, const glm::dvec2& high) {
  const double margin_m = 0.5 * std::max(high.x - low.x, high.y - low.y) + 1000;
  DegreesFit fit = Fitter(to_lon_lat, low - margin_m, high + margin_m).find_best();
  return fit.fit ? fit : Fitter(to_lon_lat, low, high).find_best();
}

}  // namespace nightcity::georeference
