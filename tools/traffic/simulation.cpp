#include "tools/traffic/simulation.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <unordered_map>

#include "tools/traffic/driver_model.h"
#include "tools/traffic/following.h"
#include "tools/traffic/junction_rules.h"
#include "tools/traffic/road_state.h"

namespace nightcity::traffic {
namespace {

// A vehicle that has stood first at a line for so long is in a gridlock: its trip is given up.
constexpr double gives_up_s = 90;
constexpr double warm_up_share = 1.0;  // of a cycle, before trips are kept
// So many of the trips that wait to start on one lane look for room, in the order in which they
// came; the others queue behind them. So a step does not become longer where more is asked for
// than streets take.
constexpr std::uint32_t max_looking = 16;

class Simulator {
 public:
  Simulator(const LinkNetwork& network, std::span<const TripPlan> plans, double cycle_s,
            const std::function<void(DrivenTrip&&)>& sink)
      : roads_(network),
        plans_(plans),
        cycle_s_(cycle_s),
        sink_(sink),
        by_start_(plans.size()),
        looking_at_(roads_.links.size()) {
    for (std::size_t n = 0; n < plans.size(); ++n) by_start_[n] = n;
    std::stable_sort(by_start_.begin(), by_start_.end(), [&](std::size_t a, std::size_t b) {
      return plans[a].start_time_s < plans[b].start_time_s;
    });
  }

  SimulationReport run(const std::function<void(double)>& progress) {
    // From -warm-up to 0 the roads fill. Trips that start in [0, cycle) are kept; the trips of the
    // next cycle keep the roads busy until the kept ones have ended.
    const double begin = -warm_up_share * cycle_s_, end = 2 * cycle_s_;
    const auto steps = static_cast<long>(std::ceil((end - begin) / step_s));
    for (long n = 0; n < steps; ++n) {
      roads_.now = begin + static_cast<double>(n) * step_s;
      if (progress && n % 64 == 0) progress(static_cast<double>(n) / static_cast<double>(steps));
      start_trips();
      if (roads_.now >= cycle_s_ && kept_ == 0) break;
      report_.max_at_once = std::max(report_.max_at_once, roads_.active.size());
      roads_.look_ahead();
      grant_turns(roads_);
      choose_speeds(roads_);
      move();
      ++report_.steps;
    }
    report_.stuck += kept_;
    return report_;
  }

 private:
  struct PendingTrip {
    std::size_t plan;
    bool kept;  // starts in the cycle that is passed on
    double due_s;
  };

  /// Returns when the next trip is due to start, in seconds.
  double next_due_s() const {
    return next_cycle_ * cycle_s_ + plans_[by_start_[next_]].start_time_s;
  }

  std::size_t start_link(const PendingTrip& one) const { return plans_[one.plan].links.front(); }

  void start_trips() {
    while (roads_.now >= next_due_s()) {
      const PendingTrip one{by_start_[next_], next_cycle_ == 0, next_due_s()};
      wait(one);
      if (one.kept) ++kept_;
      if (++next_ == by_start_.size()) {
        next_ = 0;
        ++next_cycle_;
      }
    }
    ++moment_;
    vacated_.clear();
    std::erase_if(looking_, [&](const PendingTrip& one) {
      // A vehicle that cannot start at once tries again every second.
      const bool looks = roads_.now < one.due_s + step_s || (moment_ + one.plan) % 4 == 0;
      const bool starts = looks && try_start(one);
      if (!starts && !is_given_up(one)) return false;
      vacated_.push_back(start_link(one));
      return true;
    });
    for (const std::size_t link : vacated_) follow_up(link);
  }

  void wait(const PendingTrip& one) {
    const std::size_t link = start_link(one);
    if (looking_at_[link] < max_looking) {
      ++looking_at_[link];
      looking_.push_back(one);
    } else {
      queued_[link].push_back(one);
    }
  }

  /// Returns whether a trip has waited for a whole cycle, and counts it then.
  bool is_given_up(const PendingTrip& one) {
    if (roads_.now < one.due_s + cycle_s_) return false;
    if (one.kept) {
      ++report_.never_started;
      --kept_;
    }
    return true;
  }

  /// Lets the next trip in the queue look for room, after one that did has left.
  void follow_up(std::size_t link) {
    --looking_at_[link];
    const auto found = queued_.find(link);
    if (found == queued_.end()) return;
    std::deque<PendingTrip>& queue = found->second;
    while (!queue.empty() && is_given_up(queue.front())) queue.pop_front();
    if (!queue.empty()) {
      ++looking_at_[link];
      looking_.push_back(queue.front());
      queue.pop_front();
    }
    if (queue.empty()) queued_.erase(found);
  }

  bool try_start(const PendingTrip& one) {
    ++report_.looks;
    const TripPlan& plan = plans_[one.plan];
    const std::size_t link = plan.links.front();
    const double half = vehicle_types[plan.type].length_m / 2;
    double v =
        plan.from_kerb ? 0 : roads_.links.speed_allowed(link, plan.start_s) * plan.speed_factor;
    for (std::uint32_t n = roads_.foremost[link]; n != no_vehicle; n = roads_.vehicles[n].behind) {
      const Vehicle& other = roads_.vehicles[n];
      const double s = other.on_leg(), gap = std::abs(s - plan.start_s) - other.half_length - half;
      if (s > plan.start_s) {  // ahead
        if (gap < standstill_gap_m) return false;
        v = std::min(
            v, std::sqrt(other.v * other.v + 2 * comfortable_braking * (gap - standstill_gap_m)));
        if (!plan.from_kerb && gap < standstill_gap_m + 0.8 * v) return false;
      } else if (gap <
                 standstill_gap_m + 1.5 * other.v + other.v * other.v / (2 * comfortable_braking)) {
        return false;
      }
    }
    const std::uint32_t number = roads_.add(plan, v);
    if (driven_.size() < roads_.vehicles.size()) driven_.resize(roads_.vehicles.size());
    driven_[number].reset();
    if (one.kept) {
      const double now = roads_.now;
      driven_[number] = DrivenTrip{one.plan, now - cycle_s_ * std::floor(now / cycle_s_), {}, {}};
      report_.waited_s += now - one.due_s;
      record(number);
    }
    return true;
  }

  void record(std::uint32_t number) {
    if (!driven_[number]) return;
    driven_[number]->distance_m.push_back(static_cast<float>(roads_.vehicles[number].distance));
    driven_[number]->speed_m_s.push_back(static_cast<float>(roads_.vehicles[number].v));
  }

  void move() {
    finished_.clear();
    for (const std::uint32_t number : roads_.active) {
      Vehicle& vehicle = roads_.vehicles[number];
      vehicle.distance += (vehicle.v + vehicle.next_v) / 2 * step_s;
      vehicle.v = vehicle.next_v;
      const std::size_t last = vehicle.leg_count() - 1;
      while (vehicle.leg < last && vehicle.distance >= vehicle.legs[vehicle.leg + 1].start)
        roads_.go_on(number);
      record(number);
      roads_.release(number, false);
      const double s = vehicle.on_leg();
      const bool there = vehicle.leg == last &&
                         (vehicle.plan->to_stop ? s > vehicle.plan->end_s - 0.6 && vehicle.v < 0.3
                                                : vehicle.distance + vehicle.v * step_s + 0.3 >
                                                      vehicle.legs.back().start);
      if (there || lost(vehicle)) finished_.push_back(number);
    }
    for (const std::uint32_t number : finished_) finish(number);
  }

  bool lost(const Vehicle& vehicle) const {
    return roads_.now - vehicle.born > cycle_s_ - 2 * step_s ||
           roads_.now - vehicle.standing_since > gives_up_s;
  }

  void finish(std::uint32_t number) {
    if (driven_[number]) {
      --kept_;
      if (lost(roads_.vehicles[number])) {
        ++report_.stuck;
      } else {
        ++report_.driven;
        sink_(std::move(*driven_[number]));
      }
      driven_[number].reset();
    }
    roads_.remove(number);
  }

  RoadState roads_;
  std::span<const TripPlan> plans_;
  double cycle_s_;
  const std::function<void(DrivenTrip&&)>& sink_;
  SimulationReport report_;
  std::vector<std::size_t> by_start_;              // plans, by start time
  std::vector<std::optional<DrivenTrip>> driven_;  // by vehicle, if its trip is kept
  std::vector<std::uint32_t> finished_;
  std::vector<PendingTrip> looking_;       // for room, in the order in which they are due
  std::vector<std::uint32_t> looking_at_;  // number of them by link
  std::vector<std::size_t> vacated_;       // links of those that have left in this step
  std::unordered_map<std::size_t, std::deque<PendingTrip>> queued_;  // by link, behind them
  std::size_t moment_ = 0;
  std::size_t next_ = 0;  // into by_start_
  std::size_t kept_ = 0;  // trips of the kept cycle that have not ended
  int next_cycle_ = -1;
};

}  // namespace

SimulationReport simulate(const LinkNetwork& network, std::span<const TripPlan> plans,
                          double cycle_s, const std::function<void(DrivenTrip&&)>& sink,
                          const std::function<void(double)>& progress) {
  if (plans.empty()) return {};
  return Simulator(network, plans, cycle_s, sink).run(progress);
}

}  // namespace nightcity::traffic
