#include "tools/traffic/link_network.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

#include "tools/traffic/vehicle_types.h"

namespace nightcity::traffic {
namespace {

using glm::dvec2;

constexpr double corner_deviation_m =
    1.0;                               // how far the driven line may leave the mapped one in a bend
constexpr double corner_m = 2.5;       // between a junction's corner and where its turns begin
constexpr double bend_radius_m = 4.5;  // where a street bends at a node between two ways
constexpr double half_axle_m =
    1.4;  // the two axles are this far in front of and behind a vehicle's middle
constexpr double slowest_m_s = 1.5;      // in the tightest bend
constexpr double tightest_bend_m = 1.6;  // of a vehicle's middle, for a moment

}  // namespace

LinkNetwork::LinkNetwork(const RoadGraph& graph, place::HeightAt height_at,
                         place::InsideBuilding inside, place::DeckAt deck_at)
    : graph_(graph),
      height_at_(std::move(height_at)),
      inside_(std::move(inside)),
      deck_at_(std::move(deck_at)) {
  centrelines_.resize(graph.edges.size());
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    Centreline& centreline = centrelines_[e];
    centreline.line = round_corners(graph.edges[e].line, corner_deviation_m);
    centreline.length = length_of(centreline.line);
    const double most = 0.45 * centreline.length;
    centreline.begin = std::min(setback(e, true), most);
    centreline.end = centreline.length - std::min(setback(e, false), most);
  }
}

double LinkNetwork::lane_length(std::size_t edge) const {
  return centrelines_[edge].end - centrelines_[edge].begin;
}

/// Returns how far from a node its turns begin, in metres: clear of the streets that cross, or as
/// far as a change of lanes needs.
double LinkNetwork::setback(std::size_t edge, bool at_start) const {
  const RoadEdge& own = graph_.edges[edge];
  const std::size_t number = at_start ? own.from : own.to;
  const RoadNode& node = graph_.nodes[number];
  const dvec2 away = at_start ? find_start_direction(own) : -find_end_direction(own);
  double result = node.streets > 2 ? 1.5 : 0;
  const auto look = [&](std::size_t other_number, bool leaves) {
    if (other_number == edge || other_number == own.opposite) return;
    const RoadEdge& other = graph_.edges[other_number];
    const dvec2 direction = leaves ? find_start_direction(other) : -find_end_direction(other);
    const double angle = std::abs(angle_between(away, direction));
    if (node.streets <= 2) {
      // The street continues: the turn goes round the bend and shifts to where the next lanes lie.
      const double bend = std::numbers::pi - angle;
      const double aside =
          std::abs(own.lane_offset(0, graph_.side) - other.lane_offset(0, graph_.side)) +
          (own.lanes != other.lanes ? 1.5 : 0);
      result = std::max({result, 2 * corner_deviation_m / std::max(std::sin(bend / 2), 0.1),
                         bend_radius_m * std::tan(std::min(bend, 2.4) / 2), 5 * aside});
    } else if (angle < 2.6) {
      const double least = std::max(angle, 0.25);
      const double clear = (other.half_width_m + std::abs(other.middle_m) +
                            own.half_width_m * std::max(std::cos(least), 0.0)) /
                           std::sin(std::min(least, 1.5708));
      result = std::max(result, clear + corner_m);
    }
  };
  for (const std::size_t e : node.out) look(e, true);
  for (const std::size_t e : node.in) look(e, false);
  return std::min(result, 25.0);
}

bool LinkNetwork::rises_evenly(const RoadEdge& edge) const {
  return edge.structure && !(edge.bridge && deck_at_);
}

/// Returns the height of what is driven on: a bridge that carries one of the edges, or the ground.
std::optional<double> LinkNetwork::surface_at(const dvec2& place, const RoadEdge& edge,
                                              const RoadEdge& next) const {
  if (deck_at_)
    for (const RoadEdge* own : {&edge, &next})
      if (own->bridge)
        if (const auto deck = deck_at_(own->way_id, place)) return deck->z;
  return height_at_(place);
}

/// Returns the height of what is driven on at a point of a line: on two axles, or, where the ground
/// ends there, on the straight line through what there is of it near by; none where there is none.
std::optional<Curve::Height> LinkNetwork::find_height(const PlanPoint& p, const RoadEdge& edge,
                                                      const RoadEdge& next) const {
  const auto find = [&](double axles) {
    return surface_at(p.point + p.along * (axles * half_axle_m), edge, next);
  };
  const auto front = find(1), rear = find(-1);
  if (front && rear)
    return Curve::Height{(*front + *rear) / 2, (*front - *rear) / (2 * half_axle_m)};
  std::vector<std::pair<double, double>> known;  // places, in half axles, and heights
  for (const double axles : {-2.0, -1.0, 0.0, 1.0, 2.0})
    if (const auto height = find(axles)) known.emplace_back(axles, *height);
  if (known.empty()) return std::nullopt;
  const auto [first, low] = known.front();
  const auto [last, high] = known.back();
  const double slope = last > first ? (high - low) / (last - first) : 0;  // for half an axle
  return Curve::Height{low - slope * first, slope / half_axle_m};
}

/// Returns the heights of what is driven on along a line from an edge to the next. In a hole of the
/// ground the last known height continues.
std::vector<Curve::Height> LinkNetwork::find_surface(const PlanLine& line, const RoadEdge& edge,
                                                     const RoadEdge& next, double last) const {
  std::vector<Curve::Height> heights;
  for (const PlanPoint& p : line) {
    heights.push_back(find_height(p, edge, next).value_or(Curve::Height{last, 0}));
    last = heights.back().height_m;
  }
  return heights;
}

double LinkNetwork::find_rise_m(std::size_t lane, double s, double right_m) const {
  const RoadEdge& edge = graph_.edges[links_[lane].edge];
  if (rises_evenly(edge)) return 0;
  const Curve::Place place = links_[lane].curve.at(s);
  const dvec2 middle(place.point), right(place.along.y, -place.along.x);
  const auto own = surface_at(middle, edge, edge),
             beside = surface_at(middle + right * right_m, edge, edge);
  return own && beside ? *beside - *own : 0;
}

void LinkNetwork::limit_speed(Link& link, double limit) const {
  const auto& samples = link.curve.samples();
  for (const Curve::Sample& sample : samples) {
    const double bend = std::abs(sample.curvature);
    const double in_bend = bend > 1e-6 ? std::sqrt(sideways_acceleration / bend) : limit;
    link.allowed_m_s.push_back(std::max(std::min(limit, in_bend), slowest_m_s));
  }
  // From the end backwards: nobody may arrive faster than they can brake for what comes next.
  for (std::size_t n = samples.size() - 1; n-- > 0;) {
    const double next = link.allowed_m_s[n + 1], way = samples[n + 1].s - samples[n].s;
    link.allowed_m_s[n] =
        std::min(link.allowed_m_s[n], std::sqrt(next * next + 2 * comfortable_braking * way));
  }
}

bool LinkNetwork::steerable(const Curve& curve) {
  constexpr double step_m = 0.25;
  const int steps = std::max(1, static_cast<int>(std::ceil(curve.length() / step_m)));
  dvec2 last = dvec2(curve.at(0).along);
  for (int k = 1; k <= steps; ++k) {
    const dvec2 along = dvec2(curve.at(curve.length() * k / steps).along);
    if (std::abs(angle_between(last, along)) * tightest_bend_m > curve.length() / steps)
      return false;
    last = along;
  }
  return true;
}

double LinkNetwork::in_buildings(const Curve& curve) const {
  constexpr double step_m = 1.5;
  if (!inside_) return 0;
  const double half_length = vehicle_types[0].length_m / 2,
               half_width = vehicle_types[0].width_m / 2;
  const int steps = std::max(1, static_cast<int>(std::ceil(curve.length() / step_m)));
  int touching = 0;
  for (int k = 0; k <= steps; ++k) {
    const Curve::Place place = curve.at(curve.length() * k / steps);
    const dvec2 middle(place.point),
        ahead = glm::normalize(dvec2(place.along)) * half_length,
        right = glm::normalize(dvec2(place.along.y, -place.along.x)) * half_width;
    touching += inside_(middle + ahead + right) || inside_(middle + ahead - right) ||
                inside_(middle - ahead + right) || inside_(middle - ahead - right);
  }
  return curve.length() * touching / (steps + 1);
}

std::size_t LinkNetwork::lane(std::size_t edge, int lane) {
  const auto [found, is_new] = lanes_.try_emplace({edge, lane}, links_.size());
  if (!is_new) return found->second;
  const RoadEdge& road = graph_.edges[edge];
  const Centreline& centreline = centrelines_[edge];
  const PlanLine line = shifted(trimmed(centreline.line, centreline.begin, centreline.end),
                                road.lane_offset(lane, graph_.side));
  const double from = graph_.nodes[road.from].height_m, to = graph_.nodes[road.to].height_m;
  std::vector<Curve::Height> heights;
  if (rises_evenly(road)) {
    const double slope = (to - from) / centreline.length;
    double s = centreline.begin;
    for (std::size_t n = 0; n < line.size(); ++n) {
      if (n > 0) s += glm::distance(line[n - 1].point, line[n].point);
      heights.push_back({from + slope * s, slope});
    }
  } else {
    heights = find_surface(line, road, road, from);
  }
  Link link;
  link.curve = Curve(line, heights);
  link.edge = edge;
  link.lane = lane;
  limit_speed(link, road.speed_m_s);
  link.steerable = steerable(link.curve);
  if (!road.structure) link.in_buildings_m = in_buildings(link.curve);
  links_.push_back(std::move(link));
  return found->second;
}

std::size_t LinkNetwork::turn(std::size_t edge, int lane_from, std::size_t next_edge, int lane_to) {
  const auto key = std::make_tuple(edge, lane_from, next_edge, lane_to);
  if (const auto found = turns_.find(key); found != turns_.end()) return found->second;
  Link link;
  link.from = lane(edge, lane_from);
  link.to = lane(next_edge, lane_to);
  link.turn = true;
  link.edge = edge;
  link.lane = lane_from;
  link.next_edge = next_edge;
  const RoadEdge &in = graph_.edges[edge], &out = graph_.edges[next_edge];
  const Curve::Sample &a = links_[link.from].curve.samples().back(),
                      &b = links_[link.to].curve.samples().front();
  const PlanLine line =
      turn_between({dvec2(a.point), dvec2(a.along)}, {dvec2(b.point), dvec2(b.along)});
  std::vector<Curve::Height> heights;
  if (rises_evenly(in) || rises_evenly(out)) {
    const double length = length_of(line);
    double s = 0;
    for (std::size_t n = 0; n < line.size(); ++n) {
      if (n > 0) s += glm::distance(line[n - 1].point, line[n].point);
      const double x = length > 0 ? s / length : 0;
      heights.push_back(
          {glm::mix(a.point.z, b.point.z, x * x * (3 - 2 * x)), glm::mix(a.along.z, b.along.z, x)});
    }
  } else {
    heights = find_surface(line, in, out, a.point.z);
  }
  // Use exactly the ends of the lanes, because trips run over the joint.
  heights.front() = {a.point.z, a.along.z};
  heights.back() = {b.point.z, b.along.z};
  link.curve = Curve(line, heights);
  limit_speed(link, std::min(in.speed_m_s, out.speed_m_s));
  link.steerable = steerable(link.curve);
  if (!in.structure && !out.structure) link.in_buildings_m = in_buildings(link.curve);
  turns_[key] = links_.size();
  links_.push_back(std::move(link));
  return links_.size() - 1;
}

bool LinkNetwork::can_turn(std::size_t edge, int lane_from, std::size_t next_edge, int lane_to) {
  if (turns_.contains({edge, lane_from, next_edge, lane_to})) return true;
  const std::size_t from = lane(edge, lane_from), to = lane(next_edge, lane_to);
  const Curve::Sample &a = links_[from].curve.samples().back(),
                      &b = links_[to].curve.samples().front();
  const dvec2 chord = dvec2(b.point - a.point);
  const double ahead = 0.25 * glm::length(chord);  // 75 degrees aside
  return glm::dot(chord, dvec2(a.along)) > ahead && glm::dot(chord, dvec2(b.along)) > ahead;
}

Movement LinkNetwork::movement(std::size_t edge, std::size_t next_edge) const {
  const double angle = angle_between(find_end_direction(graph_.edges[edge]),
                                     find_start_direction(graph_.edges[next_edge]));
  if (std::abs(angle) < 0.6) return Movement::straight;
  return angle > 0 ? Movement::left : Movement::right;
}

double LinkNetwork::turn_radius(std::size_t edge, std::size_t next_edge) const {
  const auto lane_end = [&](std::size_t e, double s) {
    const Centreline& centreline = centrelines_[e];
    const PlanLine piece = trimmed(centreline.line, s - 0.05, s + 0.05);
    const dvec2 along = piece.front().along;
    return PlanPoint{piece.front().point +
                         dvec2(along.y, -along.x) * graph_.edges[e].lane_offset(0, graph_.side),
                     along};
  };
  const PlanPoint from = lane_end(edge, centrelines_[edge].end),
                  to = lane_end(next_edge, centrelines_[next_edge].begin);
  const double turn = std::abs(angle_between(from.along, to.along));
  // If the next lane begins behind the end of this one, only a loop would lead there.
  const dvec2 chord = to.point - from.point;
  if (glm::dot(chord, from.along) <= 0 || glm::dot(chord, to.along) <= 0) return 0;
  if (turn < 0.3) return std::numeric_limits<double>::infinity();
  return glm::length(chord) / (2 * std::sin(turn / 2));
}

}  // namespace nightcity::traffic
