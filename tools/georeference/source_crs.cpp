#include "tools/georeference/source_crs.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "formats/error.h"
#include "tools/georeference/crs_names.h"
#include "tools/georeference/local_mercator.h"
#include "tools/georeference/proj_files.h"
#include "tools/georeference/proj_operation.h"
#include "tools/georeference/source_crs_state.h"

namespace nightcity::georeference {
namespace {

const glm::dvec2 no_answer{std::numeric_limits<double>::quiet_NaN()};

}  // namespace

SourceCrs::SourceCrs() : state_(std::make_unique<State>()) {}
SourceCrs::~SourceCrs() = default;

std::unique_ptr<SourceCrs> SourceCrs::create(const std::string& definition, std::string& why,
                                             Writer writer) {
  constexpr std::size_t max_definition_bytes = 65536;  // no honest CRS has a longer WKT
  if (definition.size() > max_definition_bytes) {
    why = "too long";
    return nullptr;
  }
  std::unique_ptr<SourceCrs> out(new SourceCrs);
  State& s = *out->state_;
  PJ_CONTEXT* context = s.context.get();
  proj_log_level(context, PJ_LOG_NONE);  // we report failures ourselves, with the file
  if (writer == Writer::stranger) keep_to_own_files(context, s.refused_file);
  s.crs.reset(proj_create(context, definition.c_str()));
  if (!s.refused_file.empty()) {
    why = s.explain_refusal();
    return nullptr;
  }
  if (!s.crs || !proj_is_crs(s.crs.get()) || is_another_name(context, s.crs.get(), definition)) {
    why = "PROJ does not know it";
    return nullptr;
  }
  // Bound and compound CRSs wrap the horizontal one.
  for (int depth = 0; depth < 4; ++depth) {
    const PJ_TYPE type = proj_get_type(s.crs.get());
    if (type == PJ_TYPE_COMPOUND_CRS) {
      s.read_vertical(s.crs.get());
      s.crs.reset(proj_crs_get_sub_crs(context, s.crs.get(), 0));
    } else if (type == PJ_TYPE_BOUND_CRS) {
      s.bound = std::move(s.crs);
      s.crs.reset(proj_get_source_crs(context, s.bound.get()));
    } else {
      break;
    }
    if (!s.crs) {
      why = "it has no horizontal part";
      return nullptr;
    }
  }
  const PJ_TYPE type = proj_get_type(s.crs.get());
  s.geographic = is_geographic(s.crs.get());
  if (!s.geographic && type != PJ_TYPE_PROJECTED_CRS) {
    why = "it is neither projected nor geographic";
    return nullptr;
  }
  if (!s.read_axes(why)) return nullptr;
  const char* name = proj_get_name(s.crs.get());
  s.name = name ? name : definition;
  s.read_identity(definition);
  s.read_area();
  const PjPtr ellipsoid{proj_get_ellipsoid(context, s.crs.get())};
  if (ellipsoid)
    proj_ellipsoid_get_parameters(context, ellipsoid.get(), &s.semi_major, nullptr, nullptr,
                                  &s.inverse_flattening);
  return out;
}

std::string SourceCrs::doubt() const {
  constexpr double satellites_m = 6378137;  // the radius of WGS 84's ellipsoid and GRS 1980's
  const State& s = *state_;
  if (!s.operation || s.semi_major == satellites_m || !is_guess(s.context.get(), s.operation.get()))
    return {};
  return "no shift from WGS 84 to the datum of " + s.name +
         " is known, and none is made: lamps and streets commonly lie 60 to 460 m off; coordinates "
         "in a later CRS, control_points or a PROJ string with +towgs84 help";
}

bool SourceCrs::geographic() const {
  return state_->geographic;
}
bool SourceCrs::north_first() const {
  return state_->axes.north_axis == 0;
}
bool SourceCrs::has_area() const {
  return state_->west >= -999;
}
bool SourceCrs::counts_west_and_south() const {
  return state_->axes.east_scale < 0 && state_->axes.north_scale < 0;
}
const std::string& SourceCrs::identity() const {
  return state_->identity;
}
const std::string& SourceCrs::name() const {
  return state_->name;
}
double SourceCrs::unit_to_metre() const {
  return state_->geographic ? 1.0 : std::abs(state_->axes.east_scale);
}
double SourceCrs::height_unit_to_metre() const {
  return state_->height_scale > 0 ? state_->height_scale : unit_to_metre();
}
double SourceCrs::semi_major_m() const {
  return state_->semi_major;
}
double SourceCrs::inverse_flattening() const {
  return state_->inverse_flattening;
}
const std::string& SourceCrs::area_name() const {
  return state_->area_name;
}

glm::dvec2 SourceCrs::from_wgs84(const glm::dvec2& lon_lat) const {
  if (!(std::abs(lon_lat.x) <= 360) || !(std::abs(lon_lat.y) <= 90)) return no_answer;
  return state_->axes.from_native(
      proj_trans(state_->operation.get(), PJ_FWD, proj_coord(lon_lat.x, lon_lat.y, 0, HUGE_VAL)));
}

glm::dvec2 SourceCrs::to_wgs84(const glm::dvec2& east_north) const {
  if (!std::isfinite(east_north.x) || !std::isfinite(east_north.y)) return no_answer;
  const PJ_COORD c =
      proj_trans(state_->operation.get(), PJ_INV, state_->axes.to_native(east_north));
  if (!std::isfinite(c.xy.x) || !std::isfinite(c.xy.y)) return no_answer;
  return {c.xy.x, c.xy.y};
}

glm::dvec2 SourceCrs::to_metres_or_degrees(const glm::dvec2& numbers) const {
  const ProjAxes& axes = state_->axes;
  if (!state_->geographic) return numbers * unit_to_metre();
  // Degrees stay what they are, to the last bit, although their factor is a rounded number.
  const bool are_degrees = std::abs(std::abs(axes.east_scale) - 1) < 1e-9;
  const glm::dvec2 degrees = are_degrees ? numbers : numbers * std::abs(axes.east_scale);
  return {degrees.x + axes.meridian, degrees.y};
}

glm::dvec2 SourceCrs::to_own_lon_lat(const glm::dvec2& east_north) const {
  const State& s = *state_;
  if (!std::isfinite(east_north.x) || !std::isfinite(east_north.y)) return no_answer;
  if (s.geographic)
    return std::abs(east_north.y) <= 90 && std::abs(east_north.x) <= 360 ? east_north : no_answer;
  return s.degree_axes.from_native(
      proj_trans(s.to_degrees.get(), PJ_FWD, s.axes.to_native(east_north)));
}

std::string SourceCrs::base_definition() const {
  PJ_CONTEXT* const context = state_->context.get();
  const PjPtr base{proj_crs_get_geodetic_crs(context, state_->crs.get())};
  const char* text = base ? proj_as_wkt(context, base.get(), PJ_WKT2_2019, nullptr) : nullptr;
  return text ? text : "";
}

bool SourceCrs::is_polar() const {
  return state_->axes.is_polar;
}

SourceCrs::LocalGrid SourceCrs::find_grid(const glm::dvec2& lon_lat) const {
  const State& s = *state_;
  if (s.geographic) return {};
  constexpr double step_m = 100;
  const LocalMercator ground(s.semi_major, s.inverse_flattening, lon_lat);
  const auto on_grid = [&](const glm::dvec2& metres) {
    const PJ_COORD degrees = s.degree_axes.to_native(ground.reverse(metres));
    return s.axes.from_native(proj_trans(s.to_degrees.get(), PJ_INV, degrees));
  };
  const glm::dvec2 origin = on_grid({0, 0});
  const double east = glm::distance(on_grid({step_m, 0}), origin);
  const glm::dvec2 north = on_grid({0, step_m}) - origin;
  constexpr double degrees_per_radian = 57.29577951308232;
  return {(east + glm::length(north)) / (2 * step_m),
          std::atan2(north.x, north.y) * degrees_per_radian};
}

bool SourceCrs::area_contains(const glm::dvec2& lon_lat, double margin_deg) const {
  const State& s = *state_;
  if (std::isnan(lon_lat.x) || std::isnan(lon_lat.y)) return false;
  if (s.west < -999) return true;
  if (lon_lat.y < s.south - margin_deg || lon_lat.y > s.north + margin_deg) return false;
  const bool across_date_line = s.east < s.west;
  const double width = s.east - s.west + (across_date_line ? 360 : 0);
  const double from_west = std::fmod(lon_lat.x - s.west + margin_deg + 720, 360);
  return from_west <= width + 2 * margin_deg;
}

std::string SourceCrs::select_operation(const glm::dvec2* lon_lat) {
  State& s = *state_;
  // The register, if it has the CRS, knows better shifts than most definitions state.
  const bool is_registered = proj_get_id_code(s.crs.get(), 0) != nullptr;
  const PJ* const target = s.bound && !is_registered ? s.bound.get() : s.crs.get();
  s.operation = find_operation_from_wgs84(s.context.get(), target, lon_lat);
  if (!s.refused_file.empty()) throw Error("", "CRS " + s.name + ": " + s.explain_refusal());
  if (!s.operation) throw Error("", "PROJ has no operation from WGS 84 to " + s.name);
  return describe_operation(s.context.get(), s.operation.get());
}

}  // namespace nightcity::georeference
