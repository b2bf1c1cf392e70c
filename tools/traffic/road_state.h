// One moment of the simulation: who is where, and who may drive which turn.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/traffic/link_table.h"
#include "tools/traffic/trip_plans.h"

namespace nightcity::traffic {

constexpr double not_standing = 1e18;
constexpr double standing_m_s = 1;  // slower ones stand,
constexpr double line_m = 8;        // at a line where their bumper is no farther from it

struct Vehicle {
  const TripPlan* plan = nullptr;
  const VehicleType* type = nullptr;
  std::vector<double>
      starts;           // of each leg (one of way->links) along the route, and the end of the last
  std::size_t leg = 0;  // the one it is on
  double distance = 0;  // of its middle along the route
  double v = 0, next_v = 0;
  double half = 0;
  std::size_t granted = 0;               // turns before this leg may be driven
  std::size_t held_from = 0;             // the first leg whose turn it may still hold
  double standing_since = not_standing;  // first at a line
  double born = 0;
  enum class Wish : std::uint8_t { nothing, stands, turn } wish = Wish::nothing;

  double on_leg() const { return distance - starts[leg]; }
  /// From its middle to where a leg starts; below 0: it is behind.
  double way_to(std::size_t other_leg) const { return starts[other_leg] - distance; }
};

/// Drivers look `seconds` ahead in their own time, and at least so far.
double sight_m(const Vehicle& vehicle);

/// A turn that a car may drive and has not left.
struct Hold {
  std::uint32_t vehicle;
  std::uint32_t leg;
};

/// Who comes to a turn, and how far its middle is from the turn's start.
struct Coming {
  std::uint32_t vehicle;
  double distance;
};

struct RoadState {
  explicit RoadState(const LinkNetwork& network);

  std::uint32_t add(const TripPlan& plan, double v);
  /// From the lane or turn it is on to the next of its legs.
  void go_on(std::uint32_t number);
  void remove(std::uint32_t number);
  void hold(std::uint32_t number, std::size_t leg);
  /// Gives up turns that its whole body has left, or all of them.
  void release(std::uint32_t number, bool all);
  /// Fills `coming`.
  void look_ahead();

  LinkTable links;
  double now = 0;
  std::vector<Vehicle> vehicles;
  std::vector<std::uint32_t> active;                // ascending: the order in which cars are asked
  std::vector<std::vector<std::uint32_t>> on_link;  // the foremost first
  std::vector<std::vector<Hold>> holders;           // of a turn, in the order they got it
  std::vector<std::vector<Coming>> coming;          // to a junction's turn
  std::vector<std::uint32_t> turning;               // cars on the turns of a node

 private:
  void enter(std::uint32_t number);
  void leave(std::uint32_t number);
  void drop(std::uint32_t number, std::size_t leg);

  std::vector<std::uint32_t> free_;
  std::vector<std::size_t> touched_;
};

}  // namespace nightcity::traffic
