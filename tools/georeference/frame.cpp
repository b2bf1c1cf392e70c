#include "tools/georeference/frame.h"

#include <GeographicLib/TransverseMercator.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <optional>

#include "formats/error.h"
#include "tools/georeference/axis_order.h"
#include "tools/georeference/local_mercator.h"
#include "tools/georeference/similarity.h"
#include "tools/georeference/source_crs.h"
#include "tools/georeference/srs_names.h"

namespace nightcity::georeference {
namespace {

std::string to_text(const glm::dvec2& lon_lat) {
  char text[64];
  std::snprintf(text, sizeof text, "%.4f, %.4f", lon_lat.x, lon_lat.y);
  return text;
}

std::string first_of(std::span<const glm::dvec3> sample) {
  if (sample.empty()) return "no sample";
  char text[100];
  std::snprintf(text, sizeof text, "%.10g %.10g", sample.front().x, sample.front().y);
  return text;
}

// Software that rounds coordinates as if they were metres puts the corners of a house in one place.
std::string doubt_decimals(std::span<const glm::dvec2> degrees) {
  constexpr std::size_t enough = 8;
  constexpr double step = 1e-5;
  const auto is_rounded = [](double value) {
    return std::abs(value / step - std::round(value / step)) < 1e-6;
  };
  const bool all_are = std::all_of(degrees.begin(), degrees.end(), [&](const glm::dvec2& p) {
    return is_rounded(p.x) && is_rounded(p.y);
  });
  if (degrees.size() < enough || !all_are) return {};
  return "its degrees have at most five decimals, so that places are rounded to a metre or more: "
         "write them with eight";
}

}  // namespace

struct CityFrame::State {
  std::unique_ptr<SourceCrs> source;  // null: no CRS
  /// A projected CRS whose metres or north are none at the city (Pseudo-Mercator, grids round a
  /// pole): coordinates of the file go through it into degrees of `source`. Null for all others.
  std::unique_ptr<SourceCrs> stretched;
  AxisOrder order{false, 1};
  double unit = 1, height_unit = 1;    // source units to metres
  std::optional<LocalMercator> plane;  // geographic source, or control points
  std::optional<Similarity> similarity;
  std::string crs, description, axis_warning;
  mutable std::mutex mutex;  // a PROJ operation serves one thread at a time

  void add_doubt(const std::string& doubt) {
    if (!doubt.empty()) axis_warning += (axis_warning.empty() ? "" : "; ") + doubt;
  }
  void place_by(std::span<const ControlPoint> points);
  void leave_stretched_grid(const glm::dvec2& centre);
  glm::dvec2 to_plane(const glm::dvec2& east_north) const;
  void place_in(AxisChoice&& choice, const std::string& definition,
                std::span<const glm::dvec3> sample);
};

void CityFrame::State::place_by(std::span<const ControlPoint> points) {
  description = "no CRS: coordinates taken as east, north, height in metres";
  if (points.empty()) return;
  std::vector<glm::dvec2> lon_lat, on_plane, model;
  for (const ControlPoint& p : points) lon_lat.push_back(p.lon_lat);
  const GeographicLib::TransverseMercator& utm = GeographicLib::TransverseMercator::UTM();
  plane.emplace(utm.EquatorialRadius(), 1 / utm.Flattening(), find_median(lon_lat));
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

// Replaces a projected CRS by its geographic one where its grid is longer or shorter than the
// ground by more than a hundredth, or its north far from the true one. Map grids for surveying stay
// below 0.005; Pseudo-Mercator (EPSG:3857) is 1.52 times too large at 49 degrees north. The north
// of a grid round a pole is none: EPSG:3413 is turned by 61 degrees on Spitsbergen, and 1.9 % too
// small there. Conic grids of large countries are turned by up to 40 degrees at their ends.
void CityFrame::State::leave_stretched_grid(const glm::dvec2& centre) {
  constexpr double max_stretch = 0.01, max_turn_degrees = 45;
  if (source->geographic() || !std::isfinite(centre.x) || !std::isfinite(centre.y)) return;
  const SourceCrs::LocalGrid grid = source->find_grid(centre);
  if (!std::isfinite(grid.scale)) return;
  const bool is_turned = source->is_polar() || std::abs(grid.turn_degrees) > max_turn_degrees;
  if (!is_turned && std::abs(grid.scale - 1) <= max_stretch) return;
  std::string why;
  std::unique_ptr<SourceCrs> degrees = SourceCrs::create(source->base_definition(), why);
  if (!degrees) throw Error("", source->name() + " has no geographic CRS below it: " + why);
  height_unit = source->height_unit_to_metre();
  stretched = std::move(source);
  source = std::move(degrees);
  char text[160];
  if (is_turned)
    std::snprintf(
        text, sizeof text,
        "; a grid whose north is none here (turned by %.1f degrees, %.4g times too large), "
        "so turned into degrees",
        grid.turn_degrees, grid.scale);
  else
    std::snprintf(text, sizeof text,
                  "; no metric grid (%.4g times too large here), so turned into degrees",
                  grid.scale);
  description += text;
}

// Returns the place on the plane of coordinates as in the file, east first.
glm::dvec2 CityFrame::State::to_plane(const glm::dvec2& east_north) const {
  if (!stretched) return plane->forward(source->to_metres_or_degrees(east_north));
  return plane->forward(stretched->to_own_lon_lat(east_north * unit));
}

void CityFrame::State::place_in(AxisChoice&& choice, const std::string& definition,
                                std::span<const glm::dvec3> sample) {
  source = std::move(choice.crs);
  order = choice.order;
  description = definition;
  if (source->name() != definition) description += " (" + source->name() + ")";
  description += "; axes " + order.in_words() + " " + choice.why;
  if (choice.doubtful)
    axis_warning = "axes of " + definition + " are taken as " + order.in_words() + " " +
                   choice.why +
                   ": if the city is mirrored so, set [city] crs = \"EPSG:<code>\", with which the "
                   "area of use and the way that surfaces face decide";
  unit = source->unit_to_metre();
  height_unit = source->height_unit_to_metre();
  if (choice.inside && !sample.empty()) leave_stretched_grid(choice.centre);
  if (source->geographic()) {
    std::vector<glm::dvec2> lon_lat;
    for (const glm::dvec3& c : sample) {
      const glm::dvec2 en = order.east_north(c);
      lon_lat.push_back(stretched ? stretched->to_own_lon_lat(en * unit)
                                  : source->to_metres_or_degrees(en));
    }
    if (!stretched) add_doubt(doubt_decimals(lon_lat));
    glm::dvec2 centre = find_median(lon_lat);
    if (!std::isfinite(centre.x) || !std::isfinite(centre.y)) centre = {0, 0};
    // Rounded, so that a second bake with one tile more gets the same frame.
    centre = {std::round(centre.x * 100) / 100, std::round(centre.y * 100) / 100};
    plane.emplace(source->semi_major_m(), source->inverse_flattening(), centre);
    crs = plane->proj_string();
    description += "; projected by a transverse Mercator centred on the city";
  } else {
    crs = source->identity();
  }
  if (unit != 1 || height_unit != 1) {
    char text[100];
    std::snprintf(text, sizeof text, "; units of %.9g m (heights %.9g m) turned into metres", unit,
                  height_unit);
    description += text;
  }
  const bool placed = choice.inside && !sample.empty();
  if (placed) description += "; at " + to_text(choice.centre);
  description += "; from WGS 84: " + source->select_operation(placed ? &choice.centre : nullptr);
  add_doubt(source->doubt());
}

CityFrame CityFrame::from_srs_name(const std::string& srs_name, std::span<const glm::dvec3> sample,
                                   const Options& options) {
  auto state = std::make_unique<State>();
  const bool overridden = !options.crs_override.empty();
  const std::string& name = overridden ? options.crs_override : srs_name;
  const std::vector<std::string> definitions =
      options.crs_override == "none" ? std::vector<std::string>{} : list_crs_definitions(name);
  if (definitions.empty()) {
    state->place_by(options.control_points);
    return CityFrame(std::move(state));
  }
  std::string why;
  bool known = false;
  for (const std::string& definition : definitions) {
    std::unique_ptr<SourceCrs> crs = SourceCrs::create(
        definition, why, overridden ? SourceCrs::Writer::user : SourceCrs::Writer::stranger);
    if (!crs) continue;
    known = true;
    AxisChoice choice = choose_axis_order(std::move(crs), sample, find_axis_promise(name));
    if (!choice.inside && !overridden) {
      why = "no axis order puts its coordinates (" + first_of(sample) +
            ") into the area of use of " + choice.crs->name();
      if (!choice.crs->area_name().empty()) why += " (" + choice.crs->area_name() + ")";
      if (choice.crs->geographic() && !sample.empty() && std::abs(sample.front().x) > 360)
        why += ": they are metres or feet of a projected CRS, not degrees";
      continue;
    }
    const bool inside = choice.inside;
    if (!inside) choice.why = "although the coordinates lie outside the area of use";
    const std::string area = choice.crs->area_name();
    state->place_in(std::move(choice), definition, sample);
    if (!inside)
      state->axis_warning = "the coordinates (" + first_of(sample) +
                            ") lie outside the area of use of " + definition +
                            (area.empty() ? "" : " (" + area + ")") +
                            ": lamps and streets will not meet the model if that is not its CRS";
    return CityFrame(std::move(state));
  }
  throw Error("", "CRS \"" + name + "\": " + why +
                      "; set [city] crs = \"EPSG:<code>\" in the recipe" +
                      (known ? " to the right one" : "") +
                      ", or crs = \"none\" to use coordinates as they are");
}

void CityFrame::to_projected(std::span<glm::dvec3> coordinates) const {
  const State& s = *state_;
  if (!s.source) return;
  std::unique_lock lock(s.mutex, std::defer_lock);
  if (s.stretched) lock.lock();
  for (glm::dvec3& c : coordinates) {
    const glm::dvec2 en = s.order.east_north(c);
    const glm::dvec2 out = s.plane ? s.to_plane(en) : en * s.unit;
    c = {out.x, out.y, c.z * s.height_unit};
  }
}

void CityFrame::to_projected(std::span<glm::dvec3> coordinates,
                             const std::optional<glm::dvec3>& anchor) const {
  // Shapes are metres where the CRS counts in none: in degrees, and on a stretched grid.
  const bool has_no_metres = state_->source && state_->plane;
  if (!anchor || !has_no_metres) return to_projected(coordinates);
  glm::dvec3 origin = *anchor;
  to_projected(std::span(&origin, 1));
  for (glm::dvec3& c : coordinates) c = origin + (c - *anchor);
}

glm::dvec2 CityFrame::from_lon_lat(const glm::dvec2& lon_lat) const {
  const State& s = *state_;
  if (!has_lon_lat())
    throw Error(
        "",
        "the city has no CRS, so what has longitude and latitude cannot be placed: set [city] "
        "crs, bounds or control_points in the recipe");
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

double CityFrame::height_unit_m() const {
  return state_->height_unit;
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
const std::string& CityFrame::axis_warning() const {
  return state_->axis_warning;
}

CityFrame::CityFrame(std::unique_ptr<State> state) : state_(std::move(state)) {}
CityFrame::CityFrame(CityFrame&&) noexcept = default;
CityFrame& CityFrame::operator=(CityFrame&&) noexcept = default;
CityFrame::~CityFrame() = default;

}  // namespace nightcity::georeference
