// Handles of PROJ that free themselves, and the order, direction and scale of a CRS's horizontal
// axes.
#pragma once

#include <proj.h>

#include <glm/vec2.hpp>
#include <memory>
#include <optional>

namespace nightcity::georeference {

struct PjDeleter {
  void operator()(PJ* pj) const { proj_destroy(pj); }
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
using PjPtr = std::unique_ptr<PJ, PjDeleter>;
using PjContextPtr = std::unique_ptr<PJ_CONTEXT, PjDeleter>;

/// Converts between a CRS's own coordinates and (east, north) in metres or (longitude, latitude) in
/// degrees from Greenwich.
struct ProjAxes {
  int east_axis = 0, north_axis = 1;
  /// Metres or degrees per unit; negative for axes that point west or south.
  double east_scale = 1, north_scale = 1;
  /// Degrees east of Greenwich from which longitudes count; 0 for metres.
  double meridian = 0;
  /// The grid is laid round a pole: its eastings and northings are names, and no directions.
  bool is_polar = false;

  PJ_COORD to_native(const glm::dvec2& east_north) const;
  /// NaN where PROJ had no answer.
  glm::dvec2 from_native(const PJ_COORD& native) const;

  /// Returns none when the axes do not point east or west and north or south, and are none of a
  /// grid round a pole either.
  static std::optional<ProjAxes> read(PJ_CONTEXT* context, const PJ* crs);

 private:
  static std::optional<ProjAxes> read_polar(PJ_CONTEXT* context, const PJ* system);
};

bool is_geographic(const PJ* crs);

}  // namespace nightcity::georeference
