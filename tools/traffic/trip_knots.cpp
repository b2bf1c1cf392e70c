#include "tools/traffic/trip_knots.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "formats/traffic_pose.h"
#include "tools/traffic/driver_model.h"

namespace nightcity::traffic {
namespace {

using std::numbers::pi;

// Brake lamps come on with the pedal. Coasting decelerates by about 0.5 m/s2; where a motor brakes,
// UN Regulation 13-H has the lamps on above 1.3 m/s2 and off below 0.7 m/s2.
constexpr double pedal_m_s2 = 0.8;
constexpr int shortest_on = 2, shortest_off = 3;  // steps: a driver does not tap the pedal
constexpr std::size_t longest_moments = 96;       // 12 s between knots
constexpr double quick_turn = 0.03;               // radians in one step

double find_heading(const Curve::Place& place) {
  return std::atan2(place.along.y, place.along.x);
}

// Returns how far one heading is turned from another: in [-pi, pi].
double find_turn(double to, double from) {
  const double turn = to - from;
  return std::abs(turn) < 3.14 ? turn : std::remainder(turn, 2 * pi);  // the same, and much faster
}

TripKnot knot_at(const Curve::Place& place, double yaw, double speed, double time, bool braking,
                 const Georeference& georeference) {
  TripKnot knot{};
  knot.position = glm::vec3(georeference.to_model(place.point));
  knot.time_s = static_cast<float>(time);
  const glm::dvec3 velocity = place.along * speed;
  knot.velocity = glm::vec3(glm::dvec3(velocity.x, velocity.z, -velocity.y));
  const double turns = yaw / (2 * pi);
  const double pitch = std::atan2(place.along.z, std::hypot(place.along.x, place.along.y));
  knot.pose = static_cast<uint>(std::lround((turns - std::floor(turns)) * 65536)) & 0xFFFFu;
  const auto steep = static_cast<std::int8_t>(std::clamp(std::lround(pitch * 256), -127L, 127L));
  knot.pose |= static_cast<uint>(static_cast<std::uint8_t>(steep)) << 16;
  if (braking) knot.pose |= KNOT_BRAKING;
  return knot;
}

/// Returns for each sample whether the vehicle brakes during the step after it.
std::vector<bool> find_braking(const DrivenTrip& trip) {
  const std::size_t count = trip.speed_m_s.size();
  std::vector<bool> on(count, false);
  for (std::size_t n = 0; n + 1 < count; ++n) {
    const double a = (double{trip.speed_m_s[n + 1]} - double{trip.speed_m_s[n]}) / step_s;
    on[n] = a < -pedal_m_s2 || (trip.speed_m_s[n] < 0.1f && trip.speed_m_s[n + 1] < 0.1f);
  }
  const auto smooth = [&](bool value, int shortest) {
    for (std::size_t n = 0; n < count;) {
      std::size_t end = n;
      while (end < count && on[end] == on[n]) ++end;
      if (on[n] == value && n > 0 && end < count && end - n < static_cast<std::size_t>(shortest))
        std::fill(on.begin() + static_cast<std::ptrdiff_t>(n),
                  on.begin() + static_cast<std::ptrdiff_t>(end), !value);
      n = end;
    }
  };
  smooth(false, shortest_off);
  smooth(true, shortest_on);
  return on;
}

class KnotFitter {
 public:
  KnotFitter(const TripPath& path, const DrivenTrip& trip, const Georeference& georeference,
             const KnotTolerance& tolerance)
      : georeference_(georeference), tolerance_(tolerance) {
    const std::vector<bool> braking = find_braking(trip);
    const std::size_t last = trip.speed_m_s.size() - 1;
    // Collect the moments at which a knot may lie and, between them, those at which the fit is only
    // checked. A step in which the heading turns fast has more of them.
    Curve::Place before = path.at(double{trip.distance_m[0]});
    double heading_before = find_heading(before);
    for (std::size_t n = 0; n < last; ++n) {
      const double s0 = double{trip.distance_m[n]}, s1 = double{trip.distance_m[n + 1]};
      const double v0 = double{trip.speed_m_s[n]}, v1 = double{trip.speed_m_s[n + 1]};
      const Curve::Place after = path.at(s1);
      // The acceleration is constant within a step, as in the simulation.
      const auto at = [&](double x) {
        const double way = v0 + v1 > 0 ? (2 * v0 * x + (v1 - v0) * x * x) / (v0 + v1) : x;
        return path.at(s0 + (s1 - s0) * way);
      };
      const Curve::Place middle = at(0.5);
      const double heading_middle = find_heading(middle), heading_after = find_heading(after);
      const double turn = std::max(std::abs(find_turn(heading_middle, heading_before)),
                                   std::abs(find_turn(heading_after, heading_middle)));
      const glm::dvec3 hermite = (before.point + after.point) / 2.0 +
                                 (before.along * v0 - after.along * v1) * (step_s / 8);
      const bool rough =
          turn > quick_turn || glm::distance(hermite, middle.point) > tolerance.position_m / 2;
      const int parts = rough ? 8 : 2;
      const auto add = [&](int k, const Curve::Place& place, double heading) {
        const double x = static_cast<double>(k) / parts;
        add_moment((static_cast<double>(n) + x) * step_s, v0 + (v1 - v0) * x, braking[n], place,
                   heading);
      };
      add(0, before, heading_before);
      for (int k = 1; k < parts; ++k) {
        if (2 * k == parts) {
          add(k, middle, heading_middle);
          continue;
        }
        const Curve::Place place = at(static_cast<double>(k) / parts);
        add(k, place, find_heading(place));
      }
      before = after;
      heading_before = heading_after;
    }
    add_moment(static_cast<double>(last) * step_s, double{trip.speed_m_s[last]}, braking[last],
               before, heading_before);
  }

  std::vector<TripKnot> fit(KnotError& worst) const {
    const std::size_t last = moments_.size() - 1;
    std::vector<TripKnot> knots = {knot(0)};
    for (std::size_t from = 0; from < last;) {
      std::size_t most = from + 2;
      while (most < last && most - from < longest_moments &&
             moments_[most].braking == moments_[from].braking)
        most += 2;
      std::size_t good = from + 2;
      const TripKnot first = knots.back();
      KnotError error = error_between(first, from, good);
      // Exponential search, then bisection: the error nearly always grows with the stretch.
      bool growing = true;
      for (std::size_t step = 2; step > 1 && good < most;) {
        const std::size_t to = std::min(good + step, most);
        const KnotError now = error_between(first, from, to);
        if (fits(now)) {
          good = to;
          error = now;
          step = growing ? 2 * step : step / 4 * 2;
        } else {
          growing = false;
          step = step / 4 * 2;
        }
      }
      worst.position_m = std::max(worst.position_m, error.position_m);
      worst.heading_degrees = std::max(worst.heading_degrees, error.heading_degrees);
      knots.push_back(knot(good));
      from = good;
    }
    return knots;
  }

 private:
  struct Moment {
    double time, speed;
    bool braking;
    Curve::Place place;
    double heading;       // of the place
    glm::dvec3 position;  // in model space
  };

  void add_moment(double time, double speed, bool braking, const Curve::Place& place,
                  double heading) {
    moments_.push_back({time, speed, braking, place, heading, georeference_.to_model(place.point)});
  }

  TripKnot knot(std::size_t n) const {
    const Moment& moment = moments_[n];
    return knot_at(moment.place, moment.heading, moment.speed, moment.time, moment.braking,
                   georeference_);
  }

  bool fits(const KnotError& error) const {
    return error.position_m <= tolerance_.position_m &&
           error.heading_degrees <= tolerance_.heading_degrees;
  }

  // `first`: the knot at moment `from`.
  KnotError error_between(TripKnot first, std::size_t from, std::size_t to) const {
    TripKnot second = knot(to);
    const double begin = moments_[from].time;
    first.time_s = 0;
    second.time_s = static_cast<float>(moments_[to].time - begin);
    const KnotStretch stretch(first, second);
    KnotError error;
    for (std::size_t n = from + 1; n < to; ++n) {
      const Moment& moment = moments_[n];
      const VehiclePose pose =
          stretch.pose_at(std::clamp(moment.time - begin, 0.0, double{second.time_s}));
      const double off = glm::distance(pose.position, moment.position);
      const double turned = find_turn(pose.yaw, moment.heading);
      error.position_m = std::max(error.position_m, off);
      error.heading_degrees = std::max(error.heading_degrees, std::abs(turned) * 180 / pi);
      if (!fits(error)) break;
    }
    return error;
  }

  const Georeference& georeference_;
  const KnotTolerance& tolerance_;
  std::vector<Moment> moments_;  // a knot may lie at even ones; odd ones lie between
};

}  // namespace

std::vector<TripKnot> make_knots(const TripPath& path, const DrivenTrip& trip,
                                 const Georeference& georeference, const KnotTolerance& tolerance,
                                 KnotError& worst) {
  if (trip.speed_m_s.size() < 9 || trip.distance_m.back() - trip.distance_m.front() < 5) return {};
  return KnotFitter(path, trip, georeference, tolerance).fit(worst);
}

}  // namespace nightcity::traffic
