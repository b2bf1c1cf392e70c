// Latitudes and longitudes as people write them.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string_view>

namespace nightcity::inventory {

/// Degrees, and the axis that a letter of the compass names.
struct Angle {
  enum class Axis { unknown, latitude, longitude };
  double degrees = 0;
  Axis axis = Axis::unknown;
};

/// Returns the angle in "52°31'12.5\"N", "52 31 12.5 N", "N 52° 31.2'", "52:31:12.5", "-0,125" or
/// "13.4 E": degrees, minutes and seconds, of which the last may have decimals. Minutes and seconds
/// are less than 60. None for anything else: an "O" is east in German and west in French, and a
/// sign beside a letter contradicts it or says it twice.
std::optional<Angle> parse_angle(std::string_view text);

/// Returns longitude and latitude in degrees from one text: "52.5, 13.4" and "(52.5, 13.4)", where
/// latitude comes first, or "52°31'12\"N 13°24'18\"E" in either order.
std::optional<glm::dvec2> parse_lat_lon(std::string_view text);

}  // namespace nightcity::inventory
