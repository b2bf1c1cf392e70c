// One moment of the simulation: where the vehicles are, and which turns they may drive.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/traffic/link_table.h"
#include "tools/traffic/trip_plans.h"

namespace nightcity::traffic {

constexpr double not_standing = 1e18;
constexpr double standing_m_s = 1;  // a slower vehicle counts as standing
constexpr double line_m = 8;        // a vehicle is at a stop line if its bumper is this near to it

constexpr std::uint32_t no_vehicle = 0xFFFFFFFFu;

/// A link on a vehicle's way, with the facts about it that every step asks for: side by side in
/// memory, because a step is slow by what it has to fetch.
struct Leg {
  double start = 0;      // along the trip, m
  double entry_m_s = 0;  // speed allowed at the link's start
  std::uint32_t link = 0;
  std::uint32_t node = 0;  // of a turn
  bool turn = false, junction = false;
};

struct alignas(64) Vehicle {
  // The members that others ask for come first: together they are one line of the cache.
  double distance = 0;                   // of the vehicle's middle along the trip
  double leg_start = 0;                  // of the leg that the vehicle is on
  double v = 0, next_v = 0;              // now and after this step
  double half_length = 0;                // of the body
  std::uint32_t ahead = no_vehicle;      // on the same link
  std::uint32_t behind = no_vehicle;     // on the same link
  double acceleration = 0;               // of its type, m/s2
  double standing_since = not_standing;  // time since which it stands first at a stop line

  std::vector<Leg> legs;        // plan->links; one more says where the last one ends
  double speed_factor = 1;      // of its driver
  std::uint32_t leg = 0;        // the leg that the vehicle is on
  std::uint32_t limit = 0;      // where LinkTable has found the last speed limit on it
  std::uint32_t granted = 0;    // all turns before this leg may be driven
  std::uint32_t held_from = 0;  // the first leg whose turn the vehicle may still hold
  double born = 0;              // time of its start
  enum class Request : std::uint8_t { none, waits, turn } request = Request::none;
  const TripPlan* plan = nullptr;

  std::size_t leg_count() const { return legs.size() - 1; }
  double on_leg() const { return distance - leg_start; }
  /// Returns the distance from the vehicle's middle to the start of a leg; negative once it is
  /// behind.
  double distance_to(std::size_t other_leg) const { return legs[other_leg].start - distance; }
};

/// Returns how far the driver looks ahead, in metres: some seconds at the present speed, and
/// a least distance.
double sight_m(const Vehicle& vehicle);

/// The right to drive a turn, from its grant until the vehicle has left the turn.
struct Hold {
  std::uint32_t vehicle;
  std::uint32_t leg;
};

/// A vehicle that approaches a turn, and the distance from its middle to the turn's start.
struct Coming {
  std::uint32_t vehicle;
  double distance;
};

struct RoadState {
  explicit RoadState(const LinkNetwork& network);

  std::uint32_t add(const TripPlan& plan, double v);
  /// Moves a vehicle from the lane or turn it is on to the next of its legs.
  void go_on(std::uint32_t number);
  void remove(std::uint32_t number);
  void hold(std::uint32_t number, std::size_t leg);
  /// Gives up the turns that the vehicle's whole body has left, or all of them.
  void release(std::uint32_t number, bool all);
  /// Fills `coming` for this moment.
  void look_ahead();

  LinkTable links;
  double now = 0;
  std::vector<Vehicle> vehicles;
  std::vector<std::uint32_t> active;              // vehicles on the road, ascending
  std::vector<std::uint32_t> foremost, rearmost;  // vehicle by link, or no_vehicle
  std::vector<std::vector<Hold>> holders;         // by turn, in the order of the grants
  std::vector<std::vector<Coming>> coming;        // by turn of a junction
  std::vector<std::uint32_t> turning;             // by node: number of vehicles on its turns

 private:
  void enter(std::uint32_t number);
  void leave(std::uint32_t number);
  void drop(std::uint32_t number, std::size_t leg);

  std::vector<std::uint32_t> free_;
  std::vector<std::size_t> touched_;
};

}  // namespace nightcity::traffic
