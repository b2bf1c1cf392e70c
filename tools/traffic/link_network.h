// Lanes and the turns between them, as curves to drive along, with who gives way to whom.
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

/// Two turns of one junction that cannot be driven at once.
struct Conflict {
  std::size_t other;  // link
  double begin, end;  // where on this link the bodies' middles are too near to each other
  double other_begin, other_end;
  enum class Kind { cross, merge, diverge } kind;
  bool yields;  // this one gives way
};

struct Link {
  Curve curve;
  bool turn = false;        // between two lanes, not a lane
  std::size_t edge = none;  // a lane: its edge; a turn: the edge it leaves
  int lane = 0;
  std::size_t next_edge = none;        // a turn: the edge it enters
  std::size_t from = none, to = none;  // a turn: its lanes
  std::vector<double>
      allowed_m_s;  // at each sample: limit, bends, and braking for what lies ahead on this link
  std::vector<Conflict> conflicts;  // a turn's
  bool junction = false;            // a turn that meets others: one is told when one may go
  bool steerable = true;            // no bend of it is tighter than steering wheels allow
  double in_buildings_m = 0;  // on so much of it a car would stand with a corner in a building
};

/// Comfortable driving, m/s2: ITE's Traffic Engineering Handbook has 1.5-2 for braking and at most 2.5
/// sideways at town speeds.
constexpr double comfortable_braking = 1.6, sideways_acceleration = 2.3;

class LinkNetwork {
 public:
  /// Refers to `graph`. `inside` may be empty: there are no buildings then.
  LinkNetwork(const RoadGraph& graph, HeightAt height_at, InsideBuilding inside = {});

  /// Links are made when they are first asked for: most of a map's turns nobody takes.
  std::size_t lane(std::size_t edge, int lane);
  std::size_t turn(std::size_t edge, int lane, std::size_t next_edge, int next_lane);
  /// Whether one can steer from one lane into the other: where the second begins beside or behind the end of
  /// the first (lanes that overlap at acute corners) there is no way but a loop.
  bool can_turn(std::size_t edge, int lane, std::size_t next_edge, int next_lane);
  /// Finds the conflicts of all links made so far.
  void find_conflicts();

  const std::deque<Link>& links() const { return links_; }
  const RoadGraph& graph() const { return graph_; }
  Movement movement(std::size_t edge, std::size_t next_edge) const;
  /// Of the turn from one edge's kerb lane to another's, m; infinite where it goes straight on, 0 where
  /// none is possible.
  double turn_radius(std::size_t edge, std::size_t next_edge) const;
  /// Of a lane of the edge, roughly: between the junctions at its ends.
  double lane_length(std::size_t edge) const;

 private:
  struct Middle {  // an edge's rounded middle line between its junctions
    PlanLine line;
    double length = 0, begin = 0, end = 0;
  };
  const Middle& middle(std::size_t edge) const { return middles_[edge]; }
  double setback(std::size_t edge, bool at_start) const;
  std::vector<Curve::Height> ground(const PlanLine& line, double last) const;
  void limit_speed(Link& link, double limit) const;
  static bool steerable(const Curve& curve);
  double in_buildings(const Curve& curve) const;
  bool yields(const Link& a, const Link& b) const;
  void conflict(std::size_t a, std::size_t b);

  const RoadGraph& graph_;
  HeightAt height_at_;
  InsideBuilding inside_;
  std::vector<Middle> middles_;
  std::deque<Link> links_;
  std::map<std::pair<std::size_t, int>, std::size_t> lanes_;
  std::map<std::tuple<std::size_t, int, std::size_t, int>, std::size_t> turns_;
};

}  // namespace nightcity::traffic
