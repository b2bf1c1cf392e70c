#include "tools/georeference/frame.h"

#include <GeographicLib/TransverseMercator.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <mutex>
#include <optional>

#include "formats/error.h"
#include "tools/georeference/handedness.h"
#include "tools/georeference/placement.h"
#include "tools/georeference/source_crs.h"
#include "tools/georeference/srs_names.h"
#include "tools/median.h"

namespace nightcity {
namespace {

/// How the file's first two coordinates become east and north.
struct AxisOrder {
  bool swapped;  // the file holds north first
  double sign;   // -1: the file holds west and south (Krovak as in the register of old)

  glm::dvec2 east_north(const glm::dvec3& c) const {
    return swapped ? glm::dvec2{sign * c.y, sign * c.x} : glm::dvec2{sign * c.x, sign * c.y};
  }
  std::string words() const {
    const char* east = sign < 0 ? "west" : "east";
    const char* north = sign < 0 ? "south" : "north";
    return swapped ? std::string(north) + ", " + east : std::string(east) + ", " + north;
  }
};

/// Plane round one place, conformal, metres: a transverse Mercator with scale 1 on its central meridian.
///
/// Why not a local tangent plane (GeographicLib::LocalCartesian) for geographic CRSs: there, "up" is the axis
/// at one point, so a level street sinks 2 m in 5 km and heights of the file no longer mean heights. On a map
/// grid heights pass through unchanged, and distances are true to 1 part in 10^6 within 9 km of the central
/// meridian.
struct LocalMercator {
  GeographicLib::TransverseMercator projection;
  double lon0, lat0, y0 = 0;
  double a, inverse_f;

  LocalMercator(double semi_major, double inverse_flattening, const glm::dvec2& centre)
      : projection(semi_major, inverse_flattening > 0 ? 1 / inverse_flattening : 0, 1.0),
        lon0(centre.x),
        lat0(centre.y),
        a(semi_major),
        inverse_f(inverse_flattening) {
    double x = 0;
    projection.Forward(lon0, lat0, lon0, x, y0);
  }
  glm::dvec2 forward(const glm::dvec2& lon_lat) const {
    if (!(std::abs(lon_lat.y) <= 90) || !std::isfinite(lon_lat.x))
      return glm::dvec2{std::numeric_limits<double>::quiet_NaN()};
    double x = 0, y = 0;
    projection.Forward(lon0, lon_lat.y, lon_lat.x, x, y);
    return {x, y - y0};
  }
  glm::dvec2 reverse(const glm::dvec2& p) const {
    double lat = 0, lon = 0;
    projection.Reverse(lon0, p.x, p.y + y0, lat, lon);
    return {lon, lat};
  }
  std::string proj_string() const {
    char text[200];
    std::snprintf(
        text, sizeof text,
        "+proj=tmerc +lat_0=%.10g +lon_0=%.10g +k=1 +x_0=0 +y_0=0 +a=%.12g +rf=%.15g +units=m "
        "+no_defs +type=crs",
        lat0, lon0, a, inverse_f);
    return text;
  }
};

// The component-wise median: one broken coordinate does not move it.
glm::dvec2 median_of(std::span<const glm::dvec2> points) {
  std::vector<double> x, y;
  for (const glm::dvec2& p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
    x.push_back(p.x);
    y.push_back(p.y);
  }
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {median(std::move(x), none), median(std::move(y), none)};
}

struct Choice {
  std::unique_ptr<SourceCrs> crs;
  AxisOrder order{false, 1};
  std::string why;          // why this order
  glm::dvec2 centre{0, 0};  // degrees, of the CRS's own datum
  bool inside = false;
};

// How well a sample lies in the area of use: 2 inside, 1 within a margin that zones are stretched by, 0
// outside.
int fit_of(const SourceCrs& crs, const glm::dvec2& lon_lat) {
  constexpr double margin_deg = 1.5;
  return crs.area_contains(lon_lat, 0) ? 2 : crs.area_contains(lon_lat, margin_deg) ? 1 : 0;
}

Choice choose_axis_order(std::unique_ptr<SourceCrs> crs, std::span<const glm::dvec3> sample,
                         bool by_register) {
  const AxisOrder expected{by_register && crs->north_first(), 1};
  const std::string promise =
      by_register ? "as the register has it" : "as names of this form have it";
  const std::array<AxisOrder, 4> orders{expected, AxisOrder{!expected.swapped, 1},
                                        AxisOrder{false, -1}, AxisOrder{true, -1}};
  Choice choice;
  if (sample.empty()) {
    choice.order = expected;
    choice.why = promise + ", no sample to check it";
    choice.inside = true;
    choice.crs = std::move(crs);
    return choice;
  }
  int best = 0;
  std::array<int, 4> fits{};
  std::array<glm::dvec2, 4> places{};
  for (std::size_t i = 0; i < orders.size(); ++i) {
    std::vector<glm::dvec2> points;
    for (const glm::dvec3& c : sample) points.push_back(orders[i].east_north(c));
    glm::dvec2 middle = median_of(points);
    const double unit = crs->unit_to_metre();
    places[i] = crs->to_own_lon_lat(middle * unit);
    fits[i] = fit_of(*crs, places[i]);
    // Minus signs only where plus fails: a city in west and south degrees is far more often the truth.
    if (i >= 2 && (best > 0 || crs->geographic())) continue;
    if (fits[i] > best) {
      best = fits[i];
      choice.order = orders[i];
      choice.centre = places[i];
      choice.why = i == 0
                       ? promise
                       : "against the order its name promises: only so it lies in the area of use";
    }
  }
  choice.inside = best > 0;
  // Both orders possible: the rings know, for normals point outward and terrain faces up.
  constexpr double clear_sign = 0.25;
  if (fits[0] > 0 && fits[0] == fits[1]) {
    const double hand = handedness(sample);
    if (std::abs(hand) > clear_sign) {
      const bool swapped = hand < 0;
      const std::size_t i = swapped == expected.swapped ? 0 : 1;
      choice.order = orders[i];
      choice.centre = places[i];
      choice.why = i == 0 ? promise + ", and surfaces face outward so"
                          : "against the order its name promises: only so surfaces face outward";
    } else {
      choice.why = promise + "; both orders lie in the area of use";
    }
  }
  if (!choice.inside) choice.order = expected;
  choice.crs = std::move(crs);
  return choice;
}

std::string place_text(const glm::dvec2& lon_lat) {
  char text[64];
  std::snprintf(text, sizeof text, "%.4f, %.4f", lon_lat.x, lon_lat.y);
  return text;
}

std::string sample_text(std::span<const glm::dvec3> sample) {
  if (sample.empty()) return "no sample";
  char text[100];
  std::snprintf(text, sizeof text, "%.10g %.10g", sample.front().x, sample.front().y);
  return text;
}

}  // namespace

struct CityFrame::State {
  std::unique_ptr<SourceCrs> source;  // null: no CRS
  AxisOrder order{false, 1};
  double unit = 1, height_unit = 1;    // source units to metres
  std::optional<LocalMercator> plane;  // geographic source, or control points
  std::optional<Similarity> similarity;
  std::string crs, description;
  mutable std::mutex mutex;  // a PROJ operation serves one thread at a time

  void place_by(std::span<const ControlPoint> points);
  void place_in(Choice&& choice, const std::string& definition, std::span<const glm::dvec3> sample);
};

void CityFrame::State::place_by(std::span<const ControlPoint> points) {
  description = "no CRS: coordinates taken as east, north, height in metres";
  if (points.empty()) return;
  std::vector<glm::dvec2> lon_lat, on_plane, model;
  for (const ControlPoint& p : points) lon_lat.push_back(p.lon_lat);
  const GeographicLib::TransverseMercator& utm = GeographicLib::TransverseMercator::UTM();
  plane.emplace(utm.EquatorialRadius(), 1 / utm.Flattening(), median_of(lon_lat));
  for (const ControlPoint& p : points) {
    on_plane.push_back(plane->forward(p.lon_lat));
    model.push_back(p.model);
  }
  double residual = 0;
  similarity = fit_similarity(on_plane, model, residual);
  char text[160];
  std::snprintf(text, sizeof text,
                "; placed by %zu control points: scale %.6f, turned %.4f degrees, residual %.3f m",
                points.size(), std::hypot(similarity->a, similarity->b),
                std::atan2(similarity->b, similarity->a) * 57.29577951308232, residual);
  description += text;
}

void CityFrame::State::place_in(Choice&& choice, const std::string& definition,
                                std::span<const glm::dvec3> sample) {
  source = std::move(choice.crs);
  order = choice.order;
  description = definition;
  if (source->name() != definition) description += " (" + source->name() + ")";
  description += "; axes " + order.words() + " " + choice.why;
  if (source->geographic()) {
    std::vector<glm::dvec2> lon_lat;
    for (const glm::dvec3& c : sample) lon_lat.push_back(order.east_north(c));
    glm::dvec2 centre = median_of(lon_lat);
    if (!std::isfinite(centre.x) || !std::isfinite(centre.y)) centre = {0, 0};
    // Rounded, so that a second bake with one tile more gets the same frame.
    centre = {std::round(centre.x * 100) / 100, std::round(centre.y * 100) / 100};
    plane.emplace(source->semi_major_m(), source->inverse_flattening(), centre);
    crs = plane->proj_string();
    description += "; projected by a transverse Mercator centred on the city";
  } else {
    unit = source->unit_to_metre();
    crs = source->identity();
  }
  height_unit = source->height_unit_to_metre();
  if (unit != 1 || height_unit != 1) {
    char text[100];
    std::snprintf(text, sizeof text, "; units of %.9g m (heights %.9g m) turned into metres", unit,
                  height_unit);
    description += text;
  }
  const bool placed = choice.inside && !sample.empty();
  if (placed) description += "; at " + place_text(choice.centre);
  description += "; from WGS 84: " + source->select_operation(placed ? &choice.centre : nullptr);
}

CityFrame CityFrame::from_srs_name(const std::string& srs_name, std::span<const glm::dvec3> sample,
                                   const Options& options) {
  auto state = std::make_unique<State>();
  const bool overridden = !options.crs_override.empty();
  const std::string& name = overridden ? options.crs_override : srs_name;
  const std::vector<std::string> definitions =
      options.crs_override == "none" ? std::vector<std::string>{} : crs_definitions(name);
  if (definitions.empty()) {
    state->place_by(options.control_points);
    return CityFrame(std::move(state));
  }
  std::string why;
  bool known = false;
  for (const std::string& definition : definitions) {
    std::unique_ptr<SourceCrs> crs = SourceCrs::create(definition, why);
    if (!crs) continue;
    known = true;
    Choice choice = choose_axis_order(std::move(crs), sample, promises_register_axis_order(name));
    if (!choice.inside && !overridden) {
      why = "no axis order puts its coordinates (" + sample_text(sample) +
            ") into the area of use of " + choice.crs->name();
      if (!choice.crs->area_name().empty()) why += " (" + choice.crs->area_name() + ")";
      continue;
    }
    if (!choice.inside) choice.why += ", although the coordinates lie outside the area of use";
    state->place_in(std::move(choice), definition, sample);
    return CityFrame(std::move(state));
  }
  throw Error(
      "",
      "CRS \"" + name + "\": " + why +
          (known ? "; name the right one with --crs, or --crs none to use coordinates as they are"
                 : "; name the CRS with --crs EPSG:<code>, or --crs none"));
}

void CityFrame::to_projected(std::span<glm::dvec3> coordinates) const {
  const State& s = *state_;
  if (!s.source) return;
  for (glm::dvec3& c : coordinates) {
    const glm::dvec2 en = s.order.east_north(c);
    const glm::dvec2 out = s.plane ? s.plane->forward(en) : en * s.unit;
    c = {out.x, out.y, c.z * s.height_unit};
  }
}

glm::dvec2 CityFrame::from_lon_lat(const glm::dvec2& lon_lat) const {
  const State& s = *state_;
  if (!has_lon_lat())
    throw Error("",
                "the city has no CRS: lamps and roads by longitude and latitude cannot be placed; "
                "give --crs or "
                "control points");
  if (!s.source) return s.similarity->apply(s.plane->forward(lon_lat));
  glm::dvec2 p;
  {
    const std::lock_guard lock(s.mutex);
    p = s.source->from_wgs84(lon_lat);
  }
  return s.plane ? s.plane->forward(p) : p;
}

glm::dvec2 CityFrame::to_lon_lat(const glm::dvec2& east_north) const {
  const State& s = *state_;
  if (!has_lon_lat()) throw Error("", "the city has no CRS: no longitude and latitude");
  if (!s.source) return s.plane->reverse(s.similarity->invert(east_north));
  const glm::dvec2 p = s.plane ? s.plane->reverse(east_north) : east_north;
  const std::lock_guard lock(s.mutex);
  return s.source->to_wgs84(p);
}

bool CityFrame::has_lon_lat() const {
  return state_->source || state_->similarity;
}
const std::string& CityFrame::crs() const {
  return state_->crs;
}
const std::string& CityFrame::description() const {
  return state_->description;
}

CityFrame::CityFrame(std::unique_ptr<State> state) : state_(std::move(state)) {}
CityFrame::CityFrame(CityFrame&&) noexcept = default;
CityFrame& CityFrame::operator=(CityFrame&&) noexcept = default;
CityFrame::~CityFrame() = default;

}  // namespace nightcity
