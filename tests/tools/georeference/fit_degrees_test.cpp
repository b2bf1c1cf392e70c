// Polynomials of latitude and longitude against PROJ itself.
#include "tools/georeference/fit_degrees.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tools/georeference/frame.h"

namespace nightcity::georeference {
namespace {

constexpr double degree_m = 111'320;

// A city of `size_m` around a place, in a CRS.
struct City {
  CityFrame frame;
  glm::dvec2 low, high;

  City(const std::string& crs, const glm::dvec2& lon_lat, double size_m)
      : frame(CityFrame::from_srs_name(crs, {}, {})) {
    const glm::dvec2 middle = frame.from_lon_lat(lon_lat);
    low = middle - size_m / 2;
    high = middle + size_m / 2;
  }
  DegreesFit fit() const {
    return fit_degrees([this](const glm::dvec2& plane) { return frame.to_lon_lat(plane); }, low,
                       high);
  }
};

// Expects that fit and PROJ agree at random places of the city, there and back.
void expect_as_proj(const City& city, const DegreesFit& found) {
  ASSERT_TRUE(found.fit) << found.error_m;
  EXPECT_LE(found.error_m, max_fit_m);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < 300; ++i) {
    const glm::dvec2 plane =
        city.low + glm::dvec2(share(random), share(random)) * (city.high - city.low);
    const glm::dvec2 truth = city.frame.to_lon_lat(plane);
    const auto degrees = to_degrees(*found.fit, plane);
    ASSERT_TRUE(degrees);
    EXPECT_NEAR(degrees->x, truth.y, max_fit_m / degree_m);
    EXPECT_NEAR(degrees->y, truth.x, max_fit_m / degree_m / std::cos(truth.y * M_PI / 180));
    const auto back = to_plane(*found.fit, truth.y, truth.x);
    ASSERT_TRUE(back);
    const glm::dvec2 by_proj = city.frame.from_lon_lat(truth);
    EXPECT_NEAR(back->x, by_proj.x, max_fit_m);
    EXPECT_NEAR(back->y, by_proj.y, max_fit_m);
    const auto again = to_plane(*found.fit, degrees->x, degrees->y);
    ASSERT_TRUE(again);
    EXPECT_NEAR(again->x, plane.x, 1e-3);
    EXPECT_NEAR(again->y, plane.y, 1e-3);
  }
}

TEST(FitDegrees, IsWithinADecimetreOfProjInCrsOfManyCountries) {
  const struct {
    const char* crs;
    glm::dvec2 lon_lat;
  } cities[] = {
      {"EPSG:28992", {4.9, 52.37}},     // Amsterdam: oblique stereographic
      {"EPSG:2056", {7.44, 46.95}},     // Bern: oblique Mercator
      {"EPSG:27700", {-0.12, 51.5}},    // London
      {"EPSG:31256", {16.37, 48.21}},   // Vienna
      {"EPSG:31287", {16.37, 48.21}},   // Vienna in Austria's Lambert grid
      {"EPSG:2263", {-74.0, 40.72}},    // New York in feet: Lambert
      {"EPSG:2154", {2.35, 48.86}},     // Paris: Lambert
      {"EPSG:3879", {24.94, 60.17}},    // Helsinki
      {"EPSG:25833", {13.4, 52.5}},     // Berlin: UTM
      {"EPSG:6677", {139.7, 35.7}},     // Tokyo
      {"EPSG:2193", {174.78, -41.29}},  // Wellington
  };
  for (const auto& [crs, lon_lat] : cities)
    for (const double size_m : {500.0, 60'000.0}) {
      SCOPED_TRACE(std::string(crs) + ", " + std::to_string(size_m));
      const City city(crs, lon_lat, size_m);
      const DegreesFit found = city.fit();
      expect_as_proj(city, found);
      if (found.fit)
        std::printf("  %s, %.0f m: %zu terms, %.4f m\n", crs, size_m, found.fit->terms,
                    found.error_m);
    }
}

// Degrees, and Pseudo-Mercator, whose metres are none: nightbake gives both a plane of their own.
TEST(FitDegrees, FollowsThePlanesThatCitiesInDegreesAreGiven) {
  for (const auto& [crs, corner, size] :
       {std::tuple{"EPSG:4326", glm::dvec3(48.2, 16.3, 0), 0.05},
        std::tuple{"EPSG:3857", glm::dvec3(1822000, 6141000, 0), 5000.0}}) {
    SCOPED_TRACE(crs);
    std::vector<glm::dvec3> sample;
    for (const double x : {0.0, 1.0})
      for (const double y : {0.0, 1.0}) sample.push_back(corner + size * glm::dvec3(x, y, 0));
    const CityFrame frame = CityFrame::from_srs_name(crs, sample, {});
    const auto to_lon_lat = [&](const glm::dvec2& plane) { return frame.to_lon_lat(plane); };
    const DegreesFit found = fit_degrees(to_lon_lat, {-3000, -3000}, {3000, 3000});
    ASSERT_TRUE(found.fit);
    const auto degrees = to_degrees(*found.fit, {1234, -567});
    ASSERT_TRUE(degrees);
    EXPECT_NEAR(degrees->x, frame.to_lon_lat({1234, -567}).y, max_fit_m / degree_m);
    EXPECT_NEAR(degrees->y, frame.to_lon_lat({1234, -567}).x, max_fit_m / degree_m);
  }
}

TEST(FitDegrees, GoesAcrossTheDateLine) {
  const City city("EPSG:32760", {179.999, -16.8}, 4000);
  const DegreesFit found = city.fit();
  ASSERT_TRUE(found.fit);
  const glm::dvec2 middle = 0.5 * (city.low + city.high);
  const auto west = to_degrees(*found.fit, middle - glm::dvec2(1500, 0)),
             east = to_degrees(*found.fit, middle + glm::dvec2(1500, 0));
  ASSERT_TRUE(west && east);
  EXPECT_GT(west->y, 179.9);
  EXPECT_LT(east->y, -179.9);
  const auto back = to_plane(*found.fit, east->x, east->y);
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->x, middle.x + 1500, 1e-3);
}

TEST(FitDegrees, IsNotWidenedWhereThereAreNoDegreesOutside) {
  const auto to_lon_lat = [](const glm::dvec2& plane) {
    return plane.x < -100 ? glm::dvec2(std::numeric_limits<double>::quiet_NaN())
                          : glm::dvec2(13 + plane.x / 68'000, 52 + plane.y / 111'000);
  };
  const DegreesFit found = fit_degrees(to_lon_lat, {0, 0}, {1000, 1000});
  ASSERT_TRUE(found.fit);
  EXPECT_TRUE(to_degrees(*found.fit, {1000, 0}));
  EXPECT_FALSE(to_degrees(*found.fit, {1001, 0}));
}

TEST(FitDegrees, IsNoneWhereDegreesJumpOrTurn) {
  // A step of a metre, a mirror, the pole, and nothing at all.
  const auto linear = [](const glm::dvec2& p) {
    return glm::dvec2(13 + p.x / 68'000, 52 + p.y / 111'000);
  };
  const auto step = [&](const glm::dvec2& p) { return linear(p + (p.x > 500 ? 1.0 : 0.0)); };
  const auto mirror = [&](const glm::dvec2& p) { return linear({-p.x, p.y}); };
  const auto pole = [](const glm::dvec2& p) {
    return glm::dvec2(std::atan2(p.x, p.y) * 180 / M_PI, 90 - std::hypot(p.x, p.y) / 111'000);
  };
  const auto nothing = [](const glm::dvec2&) {
    return glm::dvec2(std::numeric_limits<double>::quiet_NaN());
  };
  EXPECT_TRUE(fit_degrees(linear, {0, 0}, {1000, 1000}).fit);
  EXPECT_FALSE(fit_degrees(step, {0, 0}, {1000, 1000}).fit);
  EXPECT_FALSE(fit_degrees(mirror, {0, 0}, {1000, 1000}).fit);
  EXPECT_FALSE(fit_degrees(pole, {-1000, -1000}, {1000, 1000}).fit);
  EXPECT_FALSE(fit_degrees(nothing, {0, 0}, {1000, 1000}).fit);
}

}  // namespace
}  // namespace nightcity::georeference
