#include "tools/ground_cover/junction_corners.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/finite.h"
#include "tools/ground_cover/junctions.h"
#include "tools/ground_cover/street_areas.h"
#include "tools/ground_cover/way_line.h"
#include "tools/roads/carriageway.h"

namespace nightcity::ground_cover {
namespace {

using std::numbers::pi;

// Assumptions: guidelines (RASt 06) round corners by the paths of the largest vehicles that turn.
constexpr double main_radius_m = 6, local_radius_m = 4;
constexpr double min_radius_m = 0.5, min_angle = pi / 4, max_angle = 5 * pi / 6;
constexpr double hand_m = 0.3;

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

// An arm of a junction of the map.
struct Arm {
  const osm::OsmWay* way;
  roads::Carriageway road;
  bool is_forward;  // leaves the junction in the way's direction
  glm::dvec2 junction, along;
  double length_m;

  double angle() const { return std::atan2(along.y, along.x); }
  CornerArm with_half(double half_m) const { return {along, length_m, half_m}; }
  // Returns the width beside the carriageway on its left or right, seen from the junction.
  double find_beside_m(bool is_left) const {
    return find_roadside_m(way->tags, *road.road_class, is_left == is_forward ? "left" : "right");
  }
};

class CornerMaker {
 public:
  CornerMaker(const place::LonLatToFrame& to_frame, const Box& bounds, Cover& cover)
      : to_frame_(to_frame), bounds_(bounds), cover_(cover) {}

  void add(const osm::OsmWay& way) {
    const auto road = roads::read_carriageway(way.tags);
    if (!is_drivable(road) || std::string_view(road->road_class->highway) == "service" ||
        lies_inside(way.tags))
      return;
    const std::vector<glm::dvec2> line = find_line(way.lon_lat, to_frame_, bounds_);
    if (line.size() != way.lon_lat.size()) return;
    for (std::size_t i = 0; i < line.size(); ++i) {
      auto& arms = arms_[{way.lon_lat[i].x, way.lon_lat[i].y}];
      if (i > 0) add_arm(way, *road, line[i], line[i - 1], false, arms);
      if (i + 1 < line.size()) add_arm(way, *road, line[i], line[i + 1], true, arms);
    }
  }

  void finish() {
    for (auto& [place, arms] : arms_) {
      if (arms.size() < 3) continue;
      std::stable_sort(arms.begin(), arms.end(),
                       [](const Arm& a, const Arm& b) { return a.angle() < b.angle(); });
      for (std::size_t i = 0; i < arms.size(); ++i) round(arms[i], arms[(i + 1) % arms.size()]);
    }
  }

 private:
  static void add_arm(const osm::OsmWay& way, const roads::Carriageway& road,
                      const glm::dvec2& junction, const glm::dvec2& next, bool is_forward,
                      std::vector<Arm>& arms) {
    const double length_m = glm::distance(junction, next);
    if (length_m > 0)
      arms.push_back({&way, road, is_forward, junction, (next - junction) / length_m, length_m});
  }

  void round(const Arm& first, const Arm& second) {
    const bool is_main = first.road.road_class->tier == roads::RoadTier::main &&
                         second.road.road_class->tier == roads::RoadTier::main;
    const double radius_m = is_main ? main_radius_m : local_radius_m,
                 half_m[] = {first.road.width_m / 2, second.road.width_m / 2},
                 beside_m[] = {first.find_beside_m(true), second.find_beside_m(false)};
    auto corner = make_corner(first.junction, first.with_half(half_m[0]),
                              second.with_half(half_m[1]), radius_m);
    if (!corner) return;
    const Arm& greater =
        first.road.road_class->rank >= second.road.road_class->rank ? first : second;
    const bool sunken = first.road.road_class->kerbed && second.road.road_class->kerbed,
               marked = true;
    cover_.add({corner_rank,
                {find_street_surface(greater.way->tags, *greater.road.road_class), sunken, marked},
                {std::move(*corner)}});
    ++cover_.rounded_corners;
    if (!(beside_m[0] > 0 && beside_m[1] > 0)) return;
    if (auto pavement = make_corner(first.junction, first.with_half(half_m[0] + beside_m[0]),
                                    second.with_half(half_m[1] + beside_m[1]),
                                    radius_m - std::max(beside_m[0], beside_m[1])))
      cover_.add(
          {pavement_rank, {GroundKind::paving_stones, false, false}, {std::move(*pavement)}});
  }

  const place::LonLatToFrame& to_frame_;
  const Box& bounds_;
  Cover& cover_;
  std::map<std::pair<double, double>, std::vector<Arm>> arms_;  // by the place as written
};

}  // namespace

std::optional<Ring> make_corner(const glm::dvec2& junction, const CornerArm& first,
                                const CornerArm& second, double radius_m) {
  const double turn = cross(first.along, second.along),
               angle = std::atan2(turn, glm::dot(first.along, second.along));
  if (!(angle >= min_angle && angle <= max_angle)) return std::nullopt;
  const glm::dvec2 left(-first.along.y, first.along.x), right(second.along.y, -second.along.x);
  // The place that lies so far to the left of the first and to the right of the second.
  const auto find_place = [&](double to_left, double to_right) {
    return (first.along * to_right + second.along * to_left) / turn;
  };
  const glm::dvec2 edges_meet = find_place(first.half_m, second.half_m);
  const double tangent = std::tan(angle / 2),  // of a radius over the length that it takes
      room_m = std::min(first.length_m - glm::dot(edges_meet, first.along),
                        second.length_m - glm::dot(edges_meet, second.along));
  const double r = std::min(radius_m, room_m * tangent);
  if (!(r >= min_radius_m)) return std::nullopt;
  const glm::dvec2 middle = find_place(first.half_m + r, second.half_m + r);
  Ring ring{junction + edges_meet * (1 - hand_m / std::max(glm::length(edges_meet), hand_m))};
  const int pieces = std::clamp(static_cast<int>(std::ceil(r)), 2, 4);
  const double from = std::atan2(-left.y, -left.x), sweep = pi - angle;
  for (int k = 0; k <= pieces; ++k) {
    const double at = from - sweep * k / pieces;
    ring.push_back(junction + middle + r * glm::dvec2(std::cos(at), std::sin(at)));
  }
  return ring;
}

void add_corners(std::span<const osm::OsmWay> ways, const place::LonLatToFrame& to_frame,
                 const Box& bounds, Cover& cover) {
  CornerMaker maker(to_frame, bounds, cover);
  for (const osm::OsmWay& way : ways) maker.add(way);
  maker.finish();
}

}  // namespace nightcity::ground_cover
