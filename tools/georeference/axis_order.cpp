#include "tools/georeference/axis_order.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "formats/finite.h"
#include "formats/median.h"
#include "tools/georeference/handedness.h"
#include "tools/georeference/right_angles.h"

namespace nightcity::georeference {
namespace {

constexpr std::size_t order_count = 4;

/// The place of the sample's middle in each order.
struct Candidates {
  std::array<AxisOrder, order_count> orders;
  std::array<glm::dvec2, order_count> places{};  // longitude, latitude, degrees
  std::array<int, order_count> fits{};
};

// Rates how well a place lies in the area of use: 2 inside, 1 within the margin that zones are
// stretched by, 0 outside.
int rate_fit(const SourceCrs& crs, const glm::dvec2& lon_lat) {
  constexpr double margin_deg = 1.5;
  return crs.area_contains(lon_lat, 0) ? 2 : crs.area_contains(lon_lat, margin_deg) ? 1 : 0;
}

Candidates rate_orders(const SourceCrs& crs, const AxisOrder& expected,
                       std::span<const glm::dvec3> sample) {
  Candidates all{{expected, AxisOrder{!expected.swapped, expected.sign},
                  AxisOrder{false, -expected.sign}, AxisOrder{true, -expected.sign}}};
  for (std::size_t i = 0; i < order_count; ++i) {
    std::vector<glm::dvec2> points;
    for (const glm::dvec3& c : sample) points.push_back(all.orders[i].east_north(c));
    all.places[i] = crs.to_own_lon_lat(crs.to_metres_or_degrees(find_median(points)));
    all.fits[i] = rate_fit(crs, all.places[i]);
  }
  return all;
}

// The first order of the best fit.
void choose_by_area(const Candidates& all, const std::string& promise, AxisChoice& choice) {
  int best = 0;
  for (std::size_t i = 0; i < order_count; ++i) {
    // Other signs only where those that are expected fail: a city in west and south degrees is far
    // more often the truth.
    if (i >= 2 && (best > 0 || choice.crs->geographic())) continue;
    if (all.fits[i] <= best) continue;
    best = all.fits[i];
    choice.order = all.orders[i];
    choice.centre = all.places[i];
    choice.why = i == 0 ? promise
                        : "against the order its name promises: only so it lies in the area of use";
    choice.doubtful = i != 0;
  }
  choice.inside = best > 0;
}

constexpr double clear_sign = 0.25;  // of a handedness

// Chooses by the rings if both orders are possible and the name fixes none: normals point outward
// and terrain faces up.
void choose_by_rings(const Candidates& all, std::span<const glm::dvec3> sample,
                     const std::string& promise, AxisChoice& choice) {
  if (all.fits[0] == 0 || all.fits[0] != all.fits[1]) return;
  const double hand = handedness(sample);
  if (!(std::abs(hand) > clear_sign)) {
    choice.why = promise + "; both orders lie in the area of use";
    return;
  }
  const bool swapped = hand < 0;
  const std::size_t i = swapped == all.orders[0].swapped ? 0 : 1;
  choice.order = all.orders[i];
  choice.centre = all.places[i];
  choice.doubtful = i != 0;
  choice.why = i == 0 ? promise + ", and surfaces face outward so"
                      : "against the order its name promises: only so surfaces face outward";
}

// A name that fixes the order is believed against the rings' winding, since solids that are inside
// out are the commonest fault of city models. Right angles do not depend on winding: where only the
// other order shows them, the file breaks its name's promise.
void keep_promise(const Candidates& all, std::span<const glm::dvec3> sample,
                  const std::string& promise, AxisChoice& choice) {
  if (all.fits[0] == 0 || all.fits[0] != all.fits[1]) return;
  if (choice.crs->geographic()) {
    constexpr std::size_t min_corners = 20, clear_ratio = 3;
    const RightAngles angles = count_right_angles(sample);
    const bool swapped = all.orders[0].swapped;
    const std::size_t promised = swapped ? angles.x_is_latitude : angles.y_is_latitude;
    const std::size_t other = swapped ? angles.y_is_latitude : angles.x_is_latitude;
    if (other >= min_corners && other > clear_ratio * promised) {
      choice.order = all.orders[1];
      choice.centre = all.places[1];
      choice.why = "against the order its name promises: only so corners are right angles";
      choice.doubtful = true;
      return;
    }
  }
  const double hand = handedness(sample);
  if (std::abs(hand) > clear_sign && (hand < 0) != all.orders[0].swapped) {
    choice.why = promise + ", although surfaces face inward so";
    choice.doubtful = true;
  }
}

}  // namespace

std::string AxisOrder::in_words() const {
  const char* east = sign < 0 ? "west" : "east";
  const char* north = sign < 0 ? "south" : "north";
  return swapped ? std::string(north) + ", " + east : std::string(east) + ", " + north;
}

AxisChoice choose_axis_order(std::unique_ptr<SourceCrs> crs, std::span<const glm::dvec3> sample,
                             AxisPromise given) {
  const bool by_register = given != AxisPromise::east_north;
  const AxisOrder expected{by_register && crs->north_first(),
                           by_register && crs->counts_west_and_south() ? -1.0 : 1.0};
  const std::string promise =
      by_register ? "in the EPSG register's order" : "in the order that names of this form mean";
  AxisChoice choice;
  choice.crs = std::move(crs);
  choice.order = expected;
  if (sample.empty()) {
    choice.why = promise + ", no sample to check it";
    choice.inside = true;
    return choice;
  }
  const Candidates all = rate_orders(*choice.crs, expected, sample);
  choose_by_area(all, promise, choice);
  if (given == AxisPromise::fixed)
    keep_promise(all, sample, promise, choice);
  else
    choose_by_rings(all, sample, promise, choice);
  return choice;
}

glm::dvec2 find_median(std::span<const glm::dvec2> points) {
  std::vector<double> x, y;
  for (const glm::dvec2& p : points) {
    if (!finite(p)) continue;
    x.push_back(p.x);
    y.push_back(p.y);
  }
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {median(std::move(x), none), median(std::move(y), none)};
}

}  // namespace nightcity::georeference
