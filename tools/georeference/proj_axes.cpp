#include "tools/georeference/proj_axes.h"

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

namespace nightcity::georeference {
namespace {

constexpr double degrees_per_radian = 57.29577951308232;  // PROJ states angular units in radians

// Paris, Ferro, Rome, Lisbon, Oslo and others are where longitudes of old surveys begin.
double read_meridian(PJ_CONTEXT* context, const PJ* crs) {
  const PjPtr meridian{proj_get_prime_meridian(context, crs)};
  double longitude = 0, factor = 0;
  if (!meridian ||
      !proj_prime_meridian_get_parameters(context, meridian.get(), &longitude, &factor, nullptr))
    return 0;
  return longitude * factor * degrees_per_radian;
}

}  // namespace

bool is_geographic(const PJ* crs) {
  const PJ_TYPE type = proj_get_type(crs);
  return type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
}

std::optional<ProjAxes> ProjAxes::read(PJ_CONTEXT* context, const PJ* crs) {
  const PjPtr system{proj_crs_get_coordinate_system(context, crs)};
  if (!system || proj_cs_get_axis_count(context, system.get()) < 2) return {};
  ProjAxes axes;
  if (is_geographic(crs)) axes.meridian = read_meridian(context, crs);
  bool have_east = false, have_north = false;
  for (int i = 0; i < 2; ++i) {
    const char* direction = nullptr;
    double factor = 1;
    proj_cs_get_axis_info(context, system.get(), i, nullptr, nullptr, &direction, &factor, nullptr,
                          nullptr, nullptr);
    const double scale = is_geographic(crs) ? factor * degrees_per_radian : factor;
    const std::string_view d = direction ? direction : "";
    if (d == "east" || d == "west") {
      axes.east_axis = i;
      axes.east_scale = d == "east" ? scale : -scale;
      have_east = true;
    } else if (d == "north" || d == "south") {
      axes.north_axis = i;
      axes.north_scale = d == "north" ? scale : -scale;
      have_north = true;
    }
  }
  if (have_east && have_north) return axes;
  if (is_geographic(crs)) return {};
  return read_polar(context, system.get());
}

// Both axes begin at a pole and point the same way, along two meridians. Seen from above, the
// register's northings lie a quarter turn anticlockwise from its eastings at either pole.
std::optional<ProjAxes> ProjAxes::read_polar(PJ_CONTEXT* context, const PJ* system) {
  ProjAxes axes;
  axes.is_polar = true;
  int eastings = 0, northings = 0;
  std::string first_direction;
  for (int i = 0; i < 2; ++i) {
    const char *name = nullptr, *direction = nullptr;
    double factor = 1;
    proj_cs_get_axis_info(context, system, i, &name, nullptr, &direction, &factor, nullptr, nullptr,
                          nullptr);
    const std::string_view n = name ? name : "", d = direction ? direction : "";
    if (d != "north" && d != "south") return {};
    if (i == 0) first_direction = d;
    if (first_direction != d) return {};
    if (n.starts_with("Easting")) {
      ++eastings;
      axes.east_axis = i;
      axes.east_scale = factor;
    } else if (n.starts_with("Northing")) {
      ++northings;
      axes.north_axis = i;
      axes.north_scale = factor;
    }
  }
  return eastings == 1 && northings == 1 ? std::optional(axes) : std::nullopt;
}

PJ_COORD ProjAxes::to_native(const glm::dvec2& p) const {
  double c[2];
  c[east_axis] = (p.x - meridian) / east_scale;
  c[north_axis] = p.y / north_scale;
  return proj_coord(c[0], c[1], 0, HUGE_VAL);
}

glm::dvec2 ProjAxes::from_native(const PJ_COORD& c) const {
  if (!std::isfinite(c.v[0]) || !std::isfinite(c.v[1]))
    return glm::dvec2{std::numeric_limits<double>::quiet_NaN()};
  return {c.v[east_axis] * east_scale + meridian, c.v[north_axis] * north_scale};
}

}  // namespace nightcity::georeference
