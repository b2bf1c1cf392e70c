// Lanes and the turns between them, as curves to drive along, and which turns give way to which.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <tuple>
#include <vector>

#include "tools/traffic/curve.h"
#include "tools/traffic/road_graph.h"

namespace nightcity::traffic {

enum class Movement { straight, left, right };

/// Another turn of the same junction that cannot be driven at the same time.
struct Conflict {
  std::size_t other;  // link
  double begin, end;  // the stretch of this link on which two vehicles would come too near
  double other_begin, other_end;
  enum class Kind { cross, merge, diverge } kind;
  bool yields;  // whether this link gives way
};

struct Link {
  Curve curve;
  bool turn = false;        // between two lanes, not a lane
  std::size_t edge = none;  // a lane: its edge; a turn: the edge it leaves
  int lane = 0;
  std::size_t next_edge = none;        // a turn: the edge it enters
  std::size_t from = none, to = none;  // a turn: its lanes
  // Speed allowed at each sample: by the limit, by bends, and by braking for what lies ahead
  // on this link.
  std::vector<double> allowed_m_s;
  std::vector<Conflict> conflicts;  // a turn's
  bool junction = false;            // a turn that conflicts with others: vehicles wait for a grant
  bool steerable = true;            // no bend is tighter than a vehicle can steer
  double in_buildings_m = 0;        // length on which a car would have a corner in a building
};

/// Comfortable driving, m/s2. The ITE's Traffic Engineering Handbook gives 1.5 to 2 for braking and
/// at most 2.5 sideways at town speeds.
constexpr double comfortable_braking = 1.6, sideways_acceleration = 2.3;

class LinkNetwork {
 public:
  /// Keeps a reference to `graph`. An empty `inside` means that there are no buildings. Bridges lie
  /// where `deck_at` says, else on the ground. Where it is empty they rise evenly from end to end,
  /// as tunnels do.
  LinkNetwork(const RoadGraph& graph, place::HeightAt height_at, place::InsideBuilding inside = {},
              place::DeckAt deck_at = {});

  /// Returns the number of a lane's or a turn's link. Links are made when they are first asked for,
  /// because nobody takes most turns of a map.
  std::size_t lane(std::size_t edge, int lane);
  std::size_t turn(std::size_t edge, int lane, std::size_t next_edge, int next_lane);
  /// Returns whether a vehicle can steer from one lane into the other. Where the second begins
  /// beside or behind the end of the first (lanes that overlap at acute corners), only a loop
  /// would lead there.
  bool can_turn(std::size_t edge, int lane, std::size_t next_edge, int next_lane);
  /// Returns by how much what is driven on lies higher `right_m` beside a lane than in it.
  double find_rise_m(std::size_t lane, double s, double right_m) const;
  /// Finds the conflicts of all links made so far.
  void find_conflicts();

  const std::deque<Link>& links() const { return links_; }
  const RoadGraph& graph() const { return graph_; }
  Movement movement(std::size_t edge, std::size_t next_edge) const;
  /// Returns the radius in metres of the turn from one edge's kerb lane to another's: infinite
  /// where it goes straight on, 0 where no turn is possible.
  double turn_radius(std::size_t edge, std::size_t next_edge) const;
  /// Returns the approximate length in metres of a lane of the edge, between the junctions
  /// at its ends.
  double lane_length(std::size_t edge) const;

 private:
  struct Centreline {  // of an edge, rounded, between its junctions
    PlanLine line;
    double length = 0, begin = 0, end = 0;
  };
  const Centreline& centreline(std::size_t edge) const { return centrelines_[edge]; }
  double setback(std::size_t edge, bool at_start) const;
  bool rises_evenly(const RoadEdge& edge) const;
  std::optional<double> surface_at(const glm::dvec2& place, const RoadEdge& edge,
                                   const RoadEdge& next) const;
  std::optional<Curve::Height> find_height(const PlanPoint& p, const RoadEdge& edge,
                                           const RoadEdge& next) const;
  std::vector<Curve::Height> find_surface(const PlanLine& line, const RoadEdge& edge,
                                          const RoadEdge& next, double last) const;
  void limit_speed(Link& link, double limit) const;
  static bool steerable(const Curve& curve);
  double in_buildings(const Curve& curve) const;
  bool yields(const Link& a, const Link& b) const;
  void conflict(std::size_t a, std::size_t b);

  const RoadGraph& graph_;
  place::HeightAt height_at_;
  place::InsideBuilding inside_;
  place::DeckAt deck_at_;
  std::vector<Centreline> centrelines_;
  std::deque<Link> links_;
  std::map<std::pair<std::size_t, int>, std::size_t> lanes_;
  std::map<std::tuple<std::size_t, int, std::size_t, int>, std::size_t> turns_;
};

}  // namespace nightcity::traffic
