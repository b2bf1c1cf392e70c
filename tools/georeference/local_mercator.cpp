#include "tools/georeference/local_mercator.h"

#include <cmath>
#include <cstdio>
#include <limits>

namespace nightcity::georeference {

LocalMercator::LocalMercator(double semi_major_m, double inverse_flattening,
                             const glm::dvec2& centre)
    : projection_(semi_major_m, inverse_flattening > 0 ? 1 / inverse_flattening : 0, 1.0),
      lon0_(centre.x),
      lat0_(centre.y),
      semi_major_m_(semi_major_m),
      inverse_flattening_(inverse_flattening) {
  double x = 0;
  projection_.Forward(lon0_, lat0_, lon0_, x, y0_);
}

glm::dvec2 LocalMercator::forward(const glm::dvec2& lon_lat) const {
  if (!(std::abs(lon_lat.y) <= 90) || !std::isfinite(lon_lat.x))
    return glm::dvec2{std::numeric_limits<double>::quiet_NaN()};
  double x = 0, y = 0;
  projection_.Forward(lon0_, lon_lat.y, lon_lat.x, x, y);
  return {x, y - y0_};
}

glm::dvec2 LocalMercator::reverse(const glm::dvec2& east_north) const {
  double lat = 0, lon = 0;
  projection_.Reverse(lon0_, east_north.x, east_north.y + y0_, lat, lon);
  return {lon, lat};
}

std::string LocalMercator::proj_string() const {
  char text[200];
  std::snprintf(
      text, sizeof text,
      "+proj=tmerc +lat_0=%.10g +lon_0=%.10g +k=1 +x_0=0 +y_0=0 +a=%.12g +rf=%.15g +units=m "
      "+no_defs +type=crs",
      lat0_, lon0_, semi_major_m_, inverse_flattening_);
  return text;
}

}  // namespace nightcity::georeference
