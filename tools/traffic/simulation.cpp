#include "tools/traffic/simulation.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace nightcity::traffic {
namespace {

constexpr double line_gap_m = 0.7;      // from the bumper to the stop line
constexpr double see_ahead_s = 8;       // drivers look this far ahead, in their own time,
constexpr double see_least_m = 45;      // and at least this far
constexpr double clear_margin_s = 1.2;  // between two who cross
constexpr double patience_s = 1.5;      // one who stands so long at a line is waited for no longer
constexpr double lost_patience_s = 12;  // then one goes where there is just room
constexpr double gives_up_s = 90;  // standing first at a line: a jam that locks itself; the drive is given up
constexpr double warm_up_share = 1.0;  // of a cycle, before the drives are kept

struct Car {
  std::size_t route = 0;
  const Route* way = nullptr;
  const VehicleType* type = nullptr;
  std::size_t leg = 0;  // into way->links
  double s = 0;         // on that link
  double base = 0;      // distance of that link's start along the route
  double v = 0, a = 0;
  double half = 0;
  std::size_t granted = 0;    // turns before this leg may be driven
  double standing_since = 0;  // at a line; greater than now: not standing
  double born = 0;
  bool kept = false;  // belongs to the cycle that is handed out
  Drive drive;

  double distance() const { return base + s; }
};

/// Seconds for `way` metres from speed v, speeding up to `most`.
double travel_time(double way, double v, double acceleration, double most) {
  if (way <= 0) return 0;
  most = std::max(most, 1.0);
  if (v >= most) return way / v;
  const double until = (most * most - v * v) / (2 * acceleration);
  if (way <= until) return (std::sqrt(v * v + 2 * acceleration * way) - v) / acceleration;
  return (most - v) / acceleration + (way - until) / most;
}

class Simulator {
 public:
  Simulator(const LinkNetwork& network, std::span<const Route> routes, double cycle_s,
            const std::function<void(Drive&&)>& sink)
      : links_(network.links()), routes_(routes), cycle_s_(cycle_s), sink_(sink) {
    on_link_.resize(links_.size());
    holders_.resize(links_.size());
    coming_.resize(links_.size());
    by_start_.resize(routes.size());
    for (std::size_t n = 0; n < routes.size(); ++n) by_start_[n] = n;
    std::stable_sort(by_start_.begin(), by_start_.end(), [&](std::size_t a, std::size_t b) {
      return routes[a].start_time_s < routes[b].start_time_s;
    });
  }

  SimulationReport run(const std::function<void(double)>& progress) {
    // From -warm-up to 0 the roads fill; starts in [0, cycle) are kept; the next cycle's starts go on
    // meanwhile.
    const double begin = -warm_up_share * cycle_s_, end = 2 * cycle_s_;
    next_ = 0;
    next_cycle_ = -1;
    const auto steps = static_cast<long>(std::ceil((end - begin) / step_s));
    for (long n = 0; n < steps; ++n) {
      now_ = begin + static_cast<double>(n) * step_s;
      if (progress && n % 64 == 0) progress(static_cast<double>(n) / static_cast<double>(steps));
      start_drives();
      if (now_ >= cycle_s_ && kept_ == 0) break;
      look_ahead();
      grant_turns();
      accelerate();
      move();
      ++report_.steps;
    }
    report_.stuck += kept_;
    return report_;
  }

 private:
  // ---- Starting -------------------------------------------------------------------------------------------

  void start_drives() {
    while (now_ >= wish()) {
      waiting_.push_back({by_start_[next_], next_cycle_ == 0, wish()});
      if (next_cycle_ == 0) ++kept_;
      if (++next_ == by_start_.size()) {
        next_ = 0;
        ++next_cycle_;
      }
    }
    std::deque<Waiting> still;
    for (const Waiting& one : waiting_) {
      if (try_start(one)) continue;
      if (now_ < one.wish + cycle_s_) {
        still.push_back(one);
      } else if (one.kept) {
        ++report_.never_started;
        --kept_;
      }
    }
    waiting_.swap(still);
  }

  /// Of the next to start, s.
  double wish() const { return next_cycle_ * cycle_s_ + routes_[by_start_[next_]].start_time_s; }

  struct Waiting {
    std::size_t route;
    bool kept;
    double wish;
  };

  bool try_start(const Waiting& one) {
    const Route& route = routes_[one.route];
    const std::size_t link = route.links.front();
    const double half = vehicle_types[route.type].length_m / 2;
    double v = route.from_kerb ? 0 : speed_allowed(links_[link], route.start_s) * route.speed_factor;
    for (const std::size_t number : on_link_[link]) {
      const Car& other = cars_[number];
      const double gap = std::abs(other.s - route.start_s) - other.half - half;
      if (other.s > route.start_s) {  // ahead
        if (gap < standstill_gap_m) return false;
        v = std::min(v, std::sqrt(other.v * other.v + 2 * comfortable_braking * (gap - standstill_gap_m)));
        if (!route.from_kerb && gap < standstill_gap_m + 0.8 * v) return false;
      } else if (gap < standstill_gap_m + 1.5 * other.v + other.v * other.v / (2 * comfortable_braking)) {
        return false;
      }
    }
    std::size_t number = cars_.size();
    if (!free_.empty()) {
      number = free_.back();
      free_.pop_back();
    } else {
      cars_.emplace_back();
    }
    Car& car = cars_[number];
    car = Car{};
    car.route = one.route;
    car.way = &route;
    car.type = &vehicle_types[route.type];
    car.half = half;
    car.s = route.start_s;
    car.v = v;
    car.granted = 1;
    car.standing_since = 1e18;
    car.born = now_;
    car.kept = one.kept;
    car.drive.route = one.route;
    car.drive.start_time_s = now_ - cycle_s_ * std::floor(now_ / cycle_s_);
    if (car.kept) report_.waited_s += now_ - one.wish;
    record(car);
    auto& row = on_link_[link];
    const auto place =
        std::find_if(row.begin(), row.end(), [&](std::size_t n) { return cars_[n].s < car.s; });
    row.insert(place, number);
    active_.insert(std::lower_bound(active_.begin(), active_.end(), number), number);
    return true;
  }

  static void record(Car& car) {
    if (!car.kept) return;
    car.drive.distance_m.push_back(static_cast<float>(car.distance()));
    car.drive.speed_m_s.push_back(static_cast<float>(car.v));
  }

  // ---- Looking ahead --------------------------------------------------------------------------------------

  static double speed_allowed(const Link& link, double s) {
    const auto& samples = link.curve.samples();
    s = std::clamp(s, 0.0, link.curve.length());
    const std::size_t n = link.curve.before(s);
    const double step = samples[n + 1].s - samples[n].s, x = step > 0 ? (s - samples[n].s) / step : 0;
    const double a = link.allowed_m_s[n], b = link.allowed_m_s[n + 1];
    return std::sqrt(a * a + (b * b - a * a) * x);  // braking is even along the way in v squared
  }

  static double sight(const Car& car) { return std::max(see_least_m, see_ahead_s * car.v); }

  /// Who comes to which turn, and how far it is.
  struct Coming {
    std::size_t car;
    double distance;  // from the car's middle to the turn's start
  };

  void look_ahead() {
    for (const std::size_t link : touched_) coming_[link].clear();
    touched_.clear();
    for (const std::size_t number : active_) {
      const Car& car = cars_[number];
      const double far = sight(car);
      double way = links_[car.way->links[car.leg]].curve.length() - car.s;
      for (std::size_t leg = car.leg + 1; leg < car.way->links.size() && way < far; ++leg) {
        const std::size_t link = car.way->links[leg];
        if (links_[link].junction) {
          if (coming_[link].empty()) touched_.push_back(link);
          coming_[link].push_back({number, way});
        }
        way += links_[link].curve.length();
      }
    }
  }

  // ---- Junctions ------------------------------------------------------------------------------------------

  void grant_turns() {
    for (const std::size_t number : active_) {
      Car& car = cars_[number];
      const auto& legs = car.way->links;
      double way = links_[legs[car.leg]].curve.length() - car.s;
      bool stands = false;
      for (std::size_t leg = car.leg + 1; leg < legs.size(); ++leg) {
        const Link& link = links_[legs[leg]];
        if (link.turn && leg >= car.granted) {
          const double needed = car.v * car.v / (2 * comfortable_braking) + car.v * 1.0 + car.half + 4;
          if (way > needed) break;
          if (link.junction && !may_go(number, legs[leg], way, leg)) {
            stands = car.v < 0.5 && way < car.half + 6;
            break;
          }
          car.granted = leg + 1;
          if (link.junction) holders_[legs[leg]].push_back(number);
        }
        way += link.curve.length();
        if (way > 80) break;
      }
      if (!stands)
        car.standing_since = 1e18;
      else if (car.standing_since > now_)
        car.standing_since = now_;
    }
  }

  /// Distance of a car's middle from the start of a link of its route near it (below 0: before it).
  double on(const Car& car, std::size_t link) const {
    const auto& legs = car.way->links;
    double back = 0, ahead = 0;
    for (std::size_t step = 0; step < 40; ++step) {
      if (step <= car.leg) {
        if (step > 0) back += links_[legs[car.leg - step]].curve.length();
        if (legs[car.leg - step] == link) return car.s + back;
      }
      if (car.leg + step < legs.size()) {
        if (legs[car.leg + step] == link) return car.s - ahead;
        ahead += links_[legs[car.leg + step]].curve.length();
      }
    }
    return 1e9;  // left behind long ago
  }

  /// Room behind a junction for one more, so that nobody stops amid it: what is free of the lane the turn
  /// leads to, less those who are already on their way there.
  bool room_behind(std::size_t number, std::size_t leg) const {
    const Car& car = cars_[number];
    const std::size_t turn = car.way->links[leg], lane = car.way->links[leg + 1];
    const double needed = 2 * car.half + 1.5;
    if (links_[lane].curve.length() < needed) return true;  // too short to stand on, at any time
    double room = links_[lane].curve.length();
    if (!on_link_[lane].empty()) {
      const Car& last = cars_[on_link_[lane].back()];
      room = last.s - last.half + last.v * last.v / (2 * comfortable_braking);
    }
    const auto claim = [&](std::size_t from) {
      for (const std::size_t other : holders_[from])
        if (other != number && on(cars_[other], from) < links_[from].curve.length())
          room -= 2 * cars_[other].half + standstill_gap_m;
    };
    claim(turn);
    for (const Conflict& conflict : links_[turn].conflicts)
      if (conflict.kind == Conflict::Kind::merge) claim(conflict.other);
    return room >= needed;
  }

  /// Whether a car that is not in the conflict yet comes so late that one who is through after `clear`
  /// seconds does not hinder it.
  static bool comes_late(const Car& other, double way, double clear) {
    return way > 0 && travel_time(way, other.v, other.type->acceleration, std::max(other.v, 5.0)) >
                          clear + clear_margin_s;
  }

  bool may_go(std::size_t number, std::size_t turn, double way, std::size_t leg) const {
    const Car& car = cars_[number];
    const Link& link = links_[turn];
    if (!room_behind(number, leg)) return false;
    const bool lost_patience = now_ - car.standing_since > lost_patience_s;
    const double most = car.way->speed_factor * speed_allowed(link, link.curve.length() / 2);
    for (const Conflict& conflict : link.conflicts) {
      if (conflict.kind == Conflict::Kind::diverge) continue;
      const double clear = travel_time(way + conflict.end + car.half, car.v, car.type->acceleration, most);
      for (const std::size_t other_number : holders_[conflict.other]) {
        const Car& other = cars_[other_number];
        const double at = on(other, conflict.other);
        if (at - other.half > conflict.other_end) continue;
        // Into one lane: behind it, as one follows on a lane.
        const double left = links_[conflict.other].curve.length() - at;
        if (conflict.kind == Conflict::Kind::merge && at > 0 && left < link.curve.length() + way - 1.0)
          continue;
        if (!comes_late(other, conflict.other_begin - other.half - at, clear)) return false;
      }
      if (!conflict.yields) continue;
      for (const Coming& coming : coming_[conflict.other]) {
        const Car& other = cars_[coming.car];
        if (coming.car == number || on(other, conflict.other) > 0) continue;
        if (now_ - other.standing_since > patience_s) continue;  // something else keeps it
        const bool at_line = coming.distance < other.half + 8;
        if (!at_line && (lost_patience || other.v < 1)) continue;  // or stands in a queue itself
        if (!comes_late(other, coming.distance + conflict.other_begin - other.half, clear)) return false;
      }
    }
    return true;
  }

  // ---- Following ------------------------------------------------------------------------------------------

  struct Leader {
    double gap = 1e9, speed = 0;
    void consider(double other_gap, double other_speed) {
      if (other_gap < gap) {
        gap = other_gap;
        speed = other_speed;
      }
    }
  };

  Leader leader_of(std::size_t number) const {
    const Car& car = cars_[number];
    const auto& legs = car.way->links;
    Leader leader;
    const double far = sight(car);
    double way = -car.s;  // from the car's middle to the start of the leg
    for (std::size_t leg = car.leg; leg < legs.size() && way < far; ++leg) {
      const std::size_t number_of_link = legs[leg];
      const auto& row = on_link_[number_of_link];
      const Car* next = nullptr;
      if (leg == car.leg) {
        const auto own = std::find(row.begin(), row.end(), number);
        if (own != row.begin()) next = &cars_[own[-1]];
      } else if (!row.empty()) {
        next = &cars_[row.back()];
      }
      if (next) leader.consider(way + next->s - next->half - car.half, next->v);
      const Link& link = links_[number_of_link];
      if (link.turn) beside(car, link, way, leader);
      if (next) break;
      way += link.curve.length();
    }
    return leader;
  }

  /// Those who leave the same lane by another turn, or come into the same lane from another: as long as their
  /// bodies are in the way they are followed as if they drove ahead. And for whoever is late across one
  /// stops.
  void beside(const Car& car, const Link& link, double way, Leader& leader) const {
    for (const Conflict& conflict : link.conflicts) {
      const auto& row = on_link_[conflict.other];
      for (const std::size_t number : row) {
        const Car& other = cars_[number];
        if (conflict.kind == Conflict::Kind::cross) {
          const double before = way + conflict.begin - car.half;
          if (before > 0 && other.s + other.half > conflict.other_begin &&
              other.s - other.half < conflict.other_end)
            leader.consider(before, 0);
        } else if (conflict.kind == Conflict::Kind::diverge) {
          if (other.s - other.half > conflict.other_end || way + other.s <= 0.01) continue;
          leader.consider(way + other.s - other.half - car.half, other.v);
        } else {
          const double left = links_[conflict.other].curve.length() - other.s;
          const double own_left = way + link.curve.length();
          if (left >= own_left) continue;
          leader.consider(own_left - left - other.half - car.half, other.v);
        }
      }
    }
  }

  void accelerate() {
    for (const std::size_t number : active_) {
      Car& car = cars_[number];
      const auto& legs = car.way->links;
      const double factor = car.way->speed_factor;
      // What bends, lines and the drive's end allow a step from here.
      const double ahead = car.s + car.v * step_s;
      double cap = factor * speed_allowed(links_[legs[car.leg]], ahead);
      const double far = sight(car);
      double way = -car.s - car.v * step_s;  // from there to the start of the leg
      for (std::size_t leg = car.leg; leg < legs.size() && way < far; ++leg) {
        const Link& link = links_[legs[leg]];
        if (leg > car.leg) {
          const double entry = factor * link.allowed_m_s.front();
          cap = std::min(cap, std::sqrt(entry * entry + 2 * comfortable_braking * std::max(way, 0.0)));
          if (link.turn && leg >= car.granted) {
            cap = std::min(cap, stopping(way - car.half - line_gap_m));
            break;
          }
        }
        if (leg + 1 == legs.size() && car.way->to_stop) cap = std::min(cap, stopping(way + car.way->end_s));
        way += link.curve.length();
      }
      const Leader leader = leader_of(number);
      const double a = car.type->acceleration;
      const double wish = factor * std::max(links_[legs[car.leg]].allowed_m_s.front(), cap);
      const double free = 1 - std::pow(car.v / std::max(wish, 1.0), 4);
      double interaction = 0;
      if (leader.gap < 1e8) {
        const double dv = car.v - leader.speed;
        const double desired =
            standstill_gap_m +
            std::max(0.0, car.v * headway_s + car.v * dv / (2 * std::sqrt(a * comfortable_braking)));
        const double ratio = desired / std::max(leader.gap, 0.1);
        interaction = ratio * ratio;
      }
      double next = car.v + a * (std::max(free, -1.0) - interaction) * step_s;
      next = std::min(next, cap);
      // Never farther than the bumper ahead, whatever the model says.
      if (leader.gap < 0.5) next = std::min(next, leader.speed * 0.5);
      next = std::max({next, car.v - hardest_braking * step_s, 0.0});
      car.a = (next - car.v) / step_s;
    }
  }

  /// Speed from which one still stops comfortably `way` metres ahead.
  static double stopping(double way) {
    return way < 0.2 ? 0.0 : std::sqrt(2 * comfortable_braking * (way - 0.1));
  }

  // ---- Moving ---------------------------------------------------------------------------------------------

  void move() {
    finished_.clear();
    for (const std::size_t number : active_) {
      Car& car = cars_[number];
      const double v = std::max(0.0, car.v + car.a * step_s);
      car.s += (car.v + v) / 2 * step_s;
      car.v = v;
      cross_links(number);
      record(car);
      release(number, false);
      const bool last = car.leg + 1 == car.way->links.size();
      const double end = links_[car.way->links[car.leg]].curve.length();
      const bool there = last && (car.way->to_stop ? car.s > car.way->end_s - 0.6 && car.v < 0.3
                                                   : car.s + car.v * step_s + 0.3 > end);
      if (there || lost(car)) finished_.push_back(number);
    }
    for (const std::size_t number : finished_) finish(number);
  }

  bool lost(const Car& car) const {
    return now_ - car.born > cycle_s_ - 2 * step_s || now_ - car.standing_since > gives_up_s;
  }

  void cross_links(std::size_t number) {
    Car& car = cars_[number];
    const auto& legs = car.way->links;
    while (car.leg + 1 < legs.size() && car.s >= links_[legs[car.leg]].curve.length()) {
      auto& row = on_link_[legs[car.leg]];
      row.erase(std::find(row.begin(), row.end(), number));
      const double length = links_[legs[car.leg]].curve.length();
      car.s -= length;
      car.base += length;
      ++car.leg;
      auto& next = on_link_[legs[car.leg]];
      const auto place =
          std::find_if(next.begin(), next.end(), [&](std::size_t n) { return cars_[n].s < car.s; });
      next.insert(place, number);
    }
  }

  /// Gives back the turns that lie behind the car's rear, or all.
  void release(std::size_t number, bool all) {
    const Car& car = cars_[number];
    double base = car.base;
    for (std::size_t leg = car.leg + 1; leg-- > 0;) {
      const Link& link = links_[car.way->links[leg]];
      const double end = base + link.curve.length();
      if (link.junction && (all || car.distance() - car.half > end)) drop_hold(number, car.way->links[leg]);
      if (!all && car.distance() - car.half > end + 60) break;
      if (leg > 0) base -= links_[car.way->links[leg - 1]].curve.length();
    }
    if (!all) return;
    for (std::size_t leg = car.leg + 1; leg < std::min(car.granted, car.way->links.size()); ++leg)
      drop_hold(number, car.way->links[leg]);
  }

  void drop_hold(std::size_t number, std::size_t link) {
    auto& row = holders_[link];
    row.erase(std::remove(row.begin(), row.end(), number), row.end());
  }

  void finish(std::size_t number) {
    Car& car = cars_[number];
    release(number, true);
    auto& row = on_link_[car.way->links[car.leg]];
    row.erase(std::find(row.begin(), row.end(), number));
    active_.erase(std::lower_bound(active_.begin(), active_.end(), number));
    if (car.kept) {
      --kept_;
      if (lost(car)) {
        ++report_.stuck;
      } else {
        ++report_.driven;
        sink_(std::move(car.drive));
      }
    }
    free_.push_back(number);
  }

  const std::deque<Link>& links_;
  std::span<const Route> routes_;
  double cycle_s_;
  const std::function<void(Drive&&)>& sink_;
  SimulationReport report_;

  std::deque<Car> cars_;
  std::vector<std::size_t> free_, active_;         // active: ascending
  std::vector<std::vector<std::size_t>> on_link_;  // cars, the foremost first
  std::vector<std::vector<std::size_t>> holders_;  // of a turn: cars that may drive it and have not left it
  std::vector<std::vector<Coming>> coming_;
  std::vector<std::size_t> touched_, finished_, by_start_;
  std::deque<Waiting> waiting_;
  std::size_t next_ = 0, kept_ = 0;
  int next_cycle_ = 0;
  double now_ = 0;
};

}  // namespace

SimulationReport simulate(const LinkNetwork& network, std::span<const Route> routes, double cycle_s,
                          const std::function<void(Drive&&)>& sink,
                          const std::function<void(double)>& progress) {
  if (routes.empty()) return {};
  return Simulator(network, routes, cycle_s, sink).run(progress);
}

}  // namespace nightcity::traffic
