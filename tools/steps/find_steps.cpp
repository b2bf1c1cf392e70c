#include "tools/steps/find_steps.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "tools/ground_cover/measured_line.h"
#include "tools/ground_cover/street_areas.h"
#include "tools/ground_cover/way_line.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/tag_values.h"
#include "tools/roads/carriageway.h"

namespace nightcity::steps {
namespace {

using ground_cover::Box;
using ground_cover::MeasuredLine;

// Places are asked this far apart, m.
constexpr double step_m = 0.25;
// Treads lie so much above the ground where they would touch it, m: two surfaces in one place would
// fight for a pixel.
constexpr double clear_m = 0.01;
// A shorter stretch holds no flight, m.
constexpr double min_flight_m = 0.5;
// Steeper than this is a ladder: DIN 18065 allows stairs up to 45 degrees.
constexpr double max_slope = 1.0;
// Less steep than this are ramps (an assumption): treads would be over 3 m deep.
constexpr double min_slope = 0.05;
// Longer flights together are left out, and counted, m; a hostile map gets no more.
constexpr double max_length_m = 1e6;

std::optional<int> read_count(const osm::OsmTags& tags) {
  const std::string text = osm::find_tag(tags, "step_count");
  int count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  constexpr int most = 2000;
  if (error != std::errc() || end == text.data() || count < 1 || count > most) return std::nullopt;
  return count;
}

// Returns 1 where the way goes up, -1 where it goes down, 0 where no tag says.
int read_incline(const osm::OsmTags& tags) {
  const std::string text = osm::find_tag(tags, "incline");
  if (text == "up") return 1;
  if (text == "down" || text.starts_with('-') || text.starts_with('_')) return -1;
  return !text.empty() && text.front() >= '1' && text.front() <= '9' ? 1 : 0;
}

class Builder {
 public:
  Builder(const ground_cover::Cover& cover, const Box& bounds, const place::LonLatToFrame& to_frame,
          const place::HeightAt& height_at, const place::InsideBuilding& inside)
      : cover_(cover),
        bounds_(bounds),
        to_frame_(to_frame),
        height_at_(height_at),
        inside_(inside) {}

  void add(const osm::OsmWay& way) {
    if (osm::find_tag(way.tags, "highway") != "steps" || osm::says_area(way.tags)) return;
    if (ground_cover::lies_inside(way.tags)) return;  // counted with the streets
    const std::vector<glm::dvec2> line = ground_cover::find_line(way.lon_lat, to_frame_, bounds_);
    if (line.size() < 2) return;
    const MeasuredLine along(line);
    if (!(along.length_m() > 0)) return;
    ++set_.report.ways;
    set_.report.mapped_m += along.length_m();
    if (set_.report.mapped_m > max_length_m)
      return leave_out("beyond the first 1000 km", along.length_m());
    width_m_ = roads::carriageway_width(way.tags);
    if (!way.tags.contains("width")) ++set_.report.assumed["width"];
    const bool counted = add_free_stretches(way.tags, along);
    if (counted) ++set_.report.counted_ways;
  }

  StepSet take() { return std::move(set_); }

 private:
  void leave_out(const char* reason, double length_m) {
    if (length_m > 0) set_.report.left_out_m[reason] += length_m;
  }

  // Returns why no step can lie at a place; null where one can.
  const char* find_obstacle(const glm::dvec2& place) const {
    if (!bounds_.holds(place)) return "beyond the ground";
    if (inside_ && inside_(place)) return "in a building or below a bridge";
    if (const auto* surface = cover_.surface_at(place); surface && surface->marked)
      return "on a carriageway";
    return height_at_(place) ? nullptr : "beyond the ground";
  }

  const char* find_obstacle(const MeasuredLine& along, double s) const {
    for (const double side : {0.0, 1.0, -1.0})
      if (const char* obstacle = find_obstacle(along.find_beside(s, side * width_m_ / 2)))
        return obstacle;
    return nullptr;
  }

  // Adds a flight for each stretch without an obstacle; returns whether the tag counts their steps.
  bool add_free_stretches(const osm::OsmTags& tags, const MeasuredLine& along) {
    const double length_m = along.length_m(), pieces = std::max(1.0, std::ceil(length_m / step_m));
    constexpr double none = -1;
    double begin_m = none;
    bool counted = false;
    for (double n = 0; n <= pieces; ++n) {
      const double from_m = n / pieces * length_m, middle_m = from_m + length_m / pieces / 2;
      const char* obstacle = n < pieces ? find_obstacle(along, middle_m) : nullptr;
      if (n < pieces && !obstacle) {
        if (begin_m == none) begin_m = from_m;
        continue;
      }
      if (obstacle) leave_out(obstacle, length_m / pieces);
      if (begin_m != none) counted |= add_flight(tags, along, begin_m, from_m);
      begin_m = none;
    }
    return counted;
  }

  // Returns the least and the greatest height of the ground across the flight between two lengths.
  std::pair<double, double> find_ground(const MeasuredLine& along, double from_m,
                                        double to_m) const {
    double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;
    const double pieces = std::max(1.0, std::ceil((to_m - from_m) / step_m));
    for (double n = 0; n <= pieces; ++n)
      for (const double side : {0.0, 1.0, -1.0}) {
        const double s = from_m + (to_m - from_m) * n / pieces;
        const auto height = height_at_(along.find_beside(s, side * width_m_ / 2));
        if (!height) continue;
        low_m = std::min(low_m, *height);
        high_m = std::max(high_m, *height);
      }
    return {low_m, high_m};
  }

  // Returns the height of the ground where a flight ends, or just within it where the end lies on
  // an obstacle: a kerb is no step.
  std::optional<double> find_end(const MeasuredLine& along, double end_m, double within_m) const {
    return height_at_(along.find_beside(find_obstacle(along, end_m) ? within_m : end_m, 0));
  }

  bool add_flight(const osm::OsmTags& tags, const MeasuredLine& along, double from_m, double to_m) {
    const double length_m = to_m - from_m;
    if (length_m < min_flight_m) {
      leave_out("shorter than a flight", length_m);
      return false;
    }
    Flight flight;
    flight.line = along.cut(from_m, to_m);
    const auto at_start = find_end(along, from_m, from_m + step_m / 4),
               at_end = find_end(along, to_m, to_m - step_m / 4);
    if (!at_start || !at_end) {
      leave_out("beyond the ground", length_m);
      return false;
    }
    const double rise_m = std::abs(*at_end - *at_start), low_m = std::min(*at_start, *at_end);
    if (rise_m < min_riser_m) {
      leave_out("on level ground, where they are a path", length_m);
      return false;
    }
    if (rise_m < min_slope * length_m) {
      leave_out("on ground less steep than 1 in 20, where they are a path", length_m);
      return false;
    }
    if (rise_m > max_slope * length_m) {
      leave_out("steeper than stairs", length_m);
      return false;
    }
    const bool goes_up = *at_end > *at_start;
    if (const int said = read_incline(tags); said != 0 && (said > 0) != goes_up) {
      leave_out("where the ground contradicts their incline", length_m);
      return false;
    }
    const auto [count, counted] = find_count(tags, rise_m, length_m, length_m / along.length_m());
    if (!goes_up) std::reverse(flight.line.begin(), flight.line.end());
    flight.width_m = width_m_;
    flight.surface = ground_cover::find_street_surface(tags, *roads::find_road_class("steps"));
    set_heights(low_m, rise_m, count, flight);
    set_.report.built_m += length_m;
    set_.report.treads += flight.treads_m.size();
    ++set_.report.flights;
    set_.flights.push_back(std::move(flight));
    return counted;
  }

  // Returns how many steps a stretch has, and whether that is what the tag says of its share of the
  // way.
  std::pair<int, bool> find_count(const osm::OsmTags& tags, double rise_m, double length_m,
                                  double share) {
    const int most = std::max(1, static_cast<int>(length_m / min_tread_m));
    if (const auto tagged = read_count(tags)) {
      const int count = std::max(1, static_cast<int>(std::lround(*tagged * share)));
      if (const double riser_m = rise_m / count;
          count <= most && riser_m >= min_riser_m && riser_m <= max_riser_m)
        return {count, true};
      ++set_.report.assumed["number of steps, because step_count does not fit the ground"];
    } else {
      ++set_.report.assumed["number of steps"];
    }
    return {std::clamp(static_cast<int>(std::lround(rise_m / usual_riser_m)), 1, most), false};
  }

  void set_heights(double low_m, double rise_m, int count, Flight& flight) const {
    const MeasuredLine along(flight.line);
    const double tread_m = along.length_m() / count;
    for (int n = 0; n < count; ++n) {
      const auto [ground_low_m, ground_high_m] = find_ground(along, n * tread_m, (n + 1) * tread_m);
      const double wanted_m = low_m + rise_m * (n + 1) / count;
      flight.treads_m.push_back(std::max(wanted_m, ground_high_m) + clear_m);
      flight.ground_m.push_back(std::min(ground_low_m, wanted_m));
    }
    // A tread below the one before it would be a trap: the ground has a hump there.
    for (std::size_t n = 1; n < flight.treads_m.size(); ++n)
      flight.treads_m[n] = std::max(flight.treads_m[n], flight.treads_m[n - 1]);
  }

  const ground_cover::Cover& cover_;
  const Box& bounds_;
  const place::LonLatToFrame& to_frame_;
  const place::HeightAt& height_at_;
  const place::InsideBuilding& inside_;
  double width_m_ = 0;  // of the present way
  StepSet set_;
};

}  // namespace

StepSet find_steps(const std::vector<osm::OsmWay>& ways, const ground_cover::Cover& cover,
                   const Box& bounds, const place::LonLatToFrame& to_frame,
                   const place::HeightAt& height_at, const place::InsideBuilding& inside) {
  Builder builder(cover, bounds, to_frame, height_at, inside);
  for (const osm::OsmWay& way : ways) builder.add(way);
  return builder.take();
}

}  // namespace nightcity::steps
