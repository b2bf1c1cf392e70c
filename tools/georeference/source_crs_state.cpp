#include "tools/georeference/source_crs_state.h"

#include <utility>

namespace nightcity::georeference {

void SourceCrs::State::read_vertical(const PJ* compound) {
  const PjPtr vertical{proj_crs_get_sub_crs(context.get(), compound, 1)};
  const PjPtr system{vertical ? proj_crs_get_coordinate_system(context.get(), vertical.get())
                              : nullptr};
  double factor = 0;
  if (system && proj_cs_get_axis_info(context.get(), system.get(), 0, nullptr, nullptr, nullptr,
                                      &factor, nullptr, nullptr, nullptr))
    height_scale = factor;
}

bool SourceCrs::State::read_axes(std::string& why) {
  const auto own = ProjAxes::read(context.get(), crs.get());
  if (!own) {
    why = "its axes do not point east and north";
    return false;
  }
  axes = *own;
  if (geographic) return true;
  const PjPtr base{proj_crs_get_geodetic_crs(context.get(), crs.get())};
  if (base)
    if (const auto base_axes = ProjAxes::read(context.get(), base.get())) {
      degree_axes = *base_axes;
      to_degrees.reset(
          proj_create_crs_to_crs_from_pj(context.get(), crs.get(), base.get(), nullptr, nullptr));
    }
  if (to_degrees) return true;
  why = "PROJ cannot turn it into degrees";
  return false;
}

void SourceCrs::State::read_identity(const std::string& definition) {
  const char* authority = proj_get_id_auth_name(crs.get(), 0);
  const char* code = proj_get_id_code(crs.get(), 0);
  identity = authority && code ? std::string(authority) + ":" + code : definition;
  if (geographic || (axes.east_scale == 1 && axes.north_scale == 1)) return;
  if (identity == "EPSG:5513") {
    identity = "EPSG:5514";  // the Krovak grid with axes east, north instead of south, west
    return;
  }
  // The scene's frame is in metres, so its definition says metres. (A PROJ string's x_0 and y_0 are
  // metres already.)
  const char* text = proj_as_proj_string(context.get(), crs.get(), PJ_PROJ_4, nullptr);
  if (!text) return;
  std::string in_units = text;
  // The frame's axes point east and north, whichever way the register's do.
  if (const auto at = in_units.find("+axis="); at != std::string::npos)
    in_units.erase(at, in_units.find(' ', at) - at + 1);
  for (const char* key : {"+units=", "+to_meter="}) {
    const auto at = in_units.find(key);
    if (at == std::string::npos) continue;
    const auto end = in_units.find(' ', at);
    identity = in_units.substr(0, at) + "+units=m" +
               (end == std::string::npos ? "" : in_units.substr(end));
    return;
  }
}

// A text of WKT 1 has a code and no area: the register has one.
void SourceCrs::State::read_area() {
  const char *area = nullptr, *authority = proj_get_id_auth_name(crs.get(), 0),
             *code = proj_get_id_code(crs.get(), 0);
  double w = 0, s = 0, e = 0, n = 0;
  const auto is_stated = [&](const PJ* of) {
    return of && proj_get_area_of_use(context.get(), of, &w, &s, &e, &n, &area) && w >= -999;
  };
  PjPtr registered;
  if (!is_stated(crs.get())) {
    if (!authority || !code) return;
    registered.reset(
        proj_create_from_database(context.get(), authority, code, PJ_CATEGORY_CRS, false, nullptr));
    if (!is_stated(registered.get())) return;
  }
  west = w, south = s, east = e, north = n;
  if (area) area_name = area;
}

}  // namespace nightcity::georeference
