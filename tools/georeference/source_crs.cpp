#include "tools/georeference/source_crs.h"

#include <proj.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <string_view>

namespace nightcity {
namespace {

struct PjDeleter {
  void operator()(PJ* pj) const { proj_destroy(pj); }
};
struct ContextDeleter {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
using PjPtr = std::unique_ptr<PJ, PjDeleter>;

constexpr double degrees_per_radian = 57.29577951308232;
const glm::dvec2 no_answer{std::numeric_limits<double>::quiet_NaN()};

bool is_geographic(PJ_TYPE type) {
  return type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
}

}  // namespace

struct SourceCrs::State {
  std::unique_ptr<PJ_CONTEXT, ContextDeleter> context{proj_context_create()};
  PjPtr crs;        // horizontal part
  PjPtr operation;  // CRS 84 (longitude, latitude) to crs
  bool geographic = false;
  // east = coordinate[east_axis] * east_scale, in metres or degrees
  int east_axis = 0, north_axis = 1;
  double east_scale = 1, north_scale = 1;
  double height_scale = 0;  // 0: no vertical part
  double semi_major = 6378137.0, inverse_flattening = 298.257223563;
  std::string name, identity, area_name;
  double west = -1000, south = -1000, east = -1000, north = -1000;  // -1000: not stated

  void read_vertical(const PJ* compound);
  bool read_axes(std::string& why);
  void read_identity(const std::string& definition);
  void read_area();
  PJ_COORD to_native(const glm::dvec2& p) const;
  glm::dvec2 from_native(const PJ_COORD& c) const;
};

void SourceCrs::State::read_vertical(const PJ* compound) {
  const PjPtr vertical{proj_crs_get_sub_crs(context.get(), compound, 1)};
  const PjPtr system{vertical ? proj_crs_get_coordinate_system(context.get(), vertical.get()) : nullptr};
  double factor = 0;
  if (system && proj_cs_get_axis_info(context.get(), system.get(), 0, nullptr, nullptr, nullptr, &factor,
                                      nullptr, nullptr, nullptr))
    height_scale = factor;
}

bool SourceCrs::State::read_axes(std::string& why) {
  const PjPtr system{proj_crs_get_coordinate_system(context.get(), crs.get())};
  if (!system || proj_cs_get_axis_count(context.get(), system.get()) < 2) {
    why = "no coordinate system";
    return false;
  }
  bool have_east = false, have_north = false;
  for (int i = 0; i < 2; ++i) {
    const char* direction = nullptr;
    double factor = 1;
    proj_cs_get_axis_info(context.get(), system.get(), i, nullptr, nullptr, &direction, &factor, nullptr,
                          nullptr, nullptr);
    // PROJ states angles in radians per unit; we keep degrees.
    const double scale = geographic ? factor * degrees_per_radian : factor;
    const std::string_view d = direction ? direction : "";
    if (d == "east" || d == "west") {
      east_axis = i;
      east_scale = d == "east" ? scale : -scale;
      have_east = true;
    } else if (d == "north" || d == "south") {
      north_axis = i;
      north_scale = d == "north" ? scale : -scale;
      have_north = true;
    }
  }
  if (have_east && have_north) return true;
  why = "its axes do not point east and north";
  return false;
}

void SourceCrs::State::read_identity(const std::string& definition) {
  const char* authority = proj_get_id_auth_name(crs.get(), 0);
  const char* code = proj_get_id_code(crs.get(), 0);
  identity = authority && code ? std::string(authority) + ":" + code : definition;
  if (geographic || (east_scale == 1 && north_scale == 1)) return;
  if (identity == "EPSG:5513") {  // Krovak south, west: the same grid with axes east, north has its own code
    identity = "EPSG:5514";
    return;
  }
  // The scene's frame is in metres: say so in what we write down. (A PROJ string's x_0 and y_0 are metres
  // already.)
  const char* text = proj_as_proj_string(context.get(), crs.get(), PJ_PROJ_4, nullptr);
  if (!text) return;
  const std::string in_units = text;
  for (const char* key : {"+units=", "+to_meter="}) {
    const auto at = in_units.find(key);
    if (at == std::string::npos) continue;
    const auto end = in_units.find(' ', at);
    identity = in_units.substr(0, at) + "+units=m" + (end == std::string::npos ? "" : in_units.substr(end));
    return;
  }
}

void SourceCrs::State::read_area() {
  const char* area = nullptr;
  double w = 0, s = 0, e = 0, n = 0;
  if (!proj_get_area_of_use(context.get(), crs.get(), &w, &s, &e, &n, &area) || w < -999) return;
  west = w, south = s, east = e, north = n;
  if (area) area_name = area;
}

PJ_COORD SourceCrs::State::to_native(const glm::dvec2& p) const {
  double c[2];
  c[east_axis] = p.x / east_scale;
  c[north_axis] = p.y / north_scale;
  return proj_coord(c[0], c[1], 0, HUGE_VAL);
}

glm::dvec2 SourceCrs::State::from_native(const PJ_COORD& c) const {
  if (!std::isfinite(c.v[0]) || !std::isfinite(c.v[1])) return no_answer;
  return {c.v[east_axis] * east_scale, c.v[north_axis] * north_scale};
}

SourceCrs::SourceCrs() : state_(std::make_unique<State>()) {}
SourceCrs::~SourceCrs() = default;

std::unique_ptr<SourceCrs> SourceCrs::create(const std::string& definition, std::string& why) {
  constexpr std::size_t longest_definition = 65536;  // a WKT of that size is no honest CRS
  if (definition.size() > longest_definition) {
    why = "too long";
    return nullptr;
  }
  std::unique_ptr<SourceCrs> out(new SourceCrs);
  State& s = *out->state_;
  PJ_CONTEXT* context = s.context.get();
  proj_log_level(context, PJ_LOG_NONE);  // failures are reported by us, with the file they concern
  s.crs.reset(proj_create(context, definition.c_str()));
  if (!s.crs || !proj_is_crs(s.crs.get())) {
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
      s.crs.reset(proj_get_source_crs(context, s.crs.get()));
    } else {
      break;
    }
    if (!s.crs) {
      why = "it has no horizontal part";
      return nullptr;
    }
  }
  const PJ_TYPE type = proj_get_type(s.crs.get());
  s.geographic = is_geographic(type);
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
  const PjPtr wgs84{proj_create(context, "OGC:CRS84")};
  if (wgs84)
    s.operation.reset(proj_create_crs_to_crs_from_pj(context, wgs84.get(), s.crs.get(), nullptr, nullptr));
  if (!s.operation) {
    why = "PROJ has no operation from WGS 84 to it";
    return nullptr;
  }
  return out;
}

bool SourceCrs::geographic() const {
  return state_->geographic;
}
bool SourceCrs::north_first() const {
  return state_->north_axis == 0;
}
const std::string& SourceCrs::identity() const {
  return state_->identity;
}
const std::string& SourceCrs::name() const {
  return state_->name;
}
double SourceCrs::unit_to_metre() const {
  return state_->geographic ? 1.0 : std::abs(state_->east_scale);
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
  return state_->from_native(
      proj_trans(state_->operation.get(), PJ_FWD, proj_coord(lon_lat.x, lon_lat.y, 0, HUGE_VAL)));
}

glm::dvec2 SourceCrs::to_wgs84(const glm::dvec2& east_north) const {
  if (!std::isfinite(east_north.x) || !std::isfinite(east_north.y)) return no_answer;
  const PJ_COORD c = proj_trans(state_->operation.get(), PJ_INV, state_->to_native(east_north));
  if (!std::isfinite(c.xy.x) || !std::isfinite(c.xy.y)) return no_answer;
  return {c.xy.x, c.xy.y};
}

bool SourceCrs::area_contains(const glm::dvec2& lon_lat, double margin_deg) const {
  const State& s = *state_;
  if (std::isnan(lon_lat.x) || std::isnan(lon_lat.y)) return false;
  if (s.west < -999) return true;
  if (lon_lat.y < s.south - margin_deg || lon_lat.y > s.north + margin_deg) return false;
  const double width = s.east >= s.west ? s.east - s.west : s.east - s.west + 360;  // across the date line
  const double from_west = std::fmod(lon_lat.x - s.west + margin_deg + 720, 360);
  return from_west <= width + 2 * margin_deg;
}

std::string SourceCrs::select_operation(const glm::dvec2& lon_lat) {
  State& s = *state_;
  PJ_CONTEXT* context = s.context.get();
  constexpr double half_city_deg = 0.5;
  PJ_AREA* area = proj_area_create();
  proj_area_set_bbox(area, lon_lat.x - half_city_deg, lon_lat.y - half_city_deg, lon_lat.x + half_city_deg,
                     lon_lat.y + half_city_deg);
  const PjPtr wgs84{proj_create(context, "OGC:CRS84")};
  PjPtr chosen{proj_create_crs_to_crs_from_pj(context, wgs84.get(), s.crs.get(), area, nullptr)};
  proj_area_destroy(area);
  if (chosen) s.operation = std::move(chosen);
  (void)from_wgs84(lon_lat);
  const PjPtr used{proj_trans_get_last_used_operation(s.operation.get())};
  if (!used) return "operation not stated by PROJ";
  const PJ_PROJ_INFO info = proj_pj_info(used.get());
  std::string text = info.description ? info.description : "unnamed operation";
  double accuracy = proj_coordoperation_get_accuracy(context, used.get());
  if (accuracy < 0) accuracy = info.accuracy;
  char number[48] = ", accuracy not stated";
  if (accuracy >= 0) std::snprintf(number, sizeof number, ", accuracy %g m", accuracy);
  return text + number;
}

}  // namespace nightcity
