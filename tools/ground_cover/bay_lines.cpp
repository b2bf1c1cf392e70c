#include "tools/ground_cover/bay_lines.h"

#include <algorithm>
#include <cmath>

#include "tools/roads/parking_lane.h"

namespace nightcity::ground_cover {
namespace {

// StVO, section 12 (3): no parking within 5 m of where the kerbs of two streets meet.
constexpr double clear_m = 5;
// RMS-1: lines of parking bays are narrow ones, 0.12 m in towns.
constexpr double bay_line_m = 0.12;
// Half a car; what is narrower holds no lines.
constexpr double min_bay_m = 0.9;

using Stretch = std::pair<double, double>;

// A side of a street with the lane along it.
struct Lane {
  roads::ParkingBay bay;
  double edge_m;     // of the bays, to the left of the way's middle: the one near to it
  double outward;    // 1 to the left, -1 to the right
  double direction;  // 1 where vehicles drive along the way on this side
};

void add_lines(const Lane& lane, const Stretch& stretch, const MeasuredLine& along,
               Painter& painter) {
  const double far_m = lane.edge_m + lane.outward * lane.bay.depth_m,
               lean_m = lane.direction * lane.bay.lean_m;
  const auto bays =
      std::floor((stretch.second - stretch.first - lane.bay.lean_m) / lane.bay.length_m);
  // A lane that leans against the way begins where its far ends do.
  const double first_m = stretch.first - std::min(0.0, lean_m);
  for (double n = 0; n <= bays && bays >= 1 && !painter.is_done(); ++n) {
    const double s = first_m + n * lane.bay.length_m;
    const double half_m = bay_line_m / 2;
    painter.add("line between parking bays", {along.find_beside(s - half_m, lane.edge_m),
                                              along.find_beside(s + half_m, lane.edge_m),
                                              along.find_beside(s + half_m + lean_m, far_m),
                                              along.find_beside(s - half_m + lean_m, far_m)});
  }
}

}  // namespace

std::vector<Stretch> find_parking_stretches(const osm::OsmWay& way, const MeasuredLine& along,
                                            std::size_t points, const Junctions& junctions) {
  std::vector<Stretch> stretches;
  double from_m = 0;
  const auto end_at = [&](double to_m) {
    if (to_m > from_m) stretches.emplace_back(from_m, to_m);
  };
  // A line that lacks some of the way's points does not say where its junctions are.
  for (std::size_t i = 0; i < points && points == way.lon_lat.size(); ++i) {
    const double reach_m = junctions.find_reach_m(way.lon_lat[i], way, clear_m);
    if (!(reach_m > 0)) continue;
    end_at(along.at(i) - reach_m);
    from_m = std::max(from_m, along.at(i) + reach_m);
  }
  end_at(along.length_m());
  return stretches;
}

void add_bay_lines(const osm::OsmWay& way, const roads::Carriageway& road,
                   const std::vector<glm::dvec2>& line, const Junctions& junctions,
                   bool on_the_left, Painter& painter) {
  for (const bool left : {true, false}) {
    const auto parking = roads::read_parking_lane(way.tags, left ? "left" : "right");
    if (!parking || !parking->marked) continue;
    if (parking->place == roads::ParkingPlace::on_kerb ||
        parking->place == roads::ParkingPlace::half_on_kerb) {
      painter.leave_out("lines of parking bays on a pavement");
      continue;
    }
    const double outward = left ? 1 : -1;
    Lane lane{parking->bay(), outward * road.width_m / 2, outward,
              left == on_the_left ? 1.0 : -1.0};
    if (road.lanes[0] == 0) lane.direction = -1;
    if (road.lanes[1] == 0) lane.direction = 1;
    const bool is_inside = parking->place == roads::ParkingPlace::lane;
    if (is_inside) {
      lane.bay.set_depth(road.parked_m[left ? 0 : 1]);
      if (lane.bay.depth_m < min_bay_m) {
        painter.leave_out("lines of a parking lane for which the carriageway is too narrow");
        continue;
      }
      lane.edge_m -= outward * lane.bay.depth_m;
    }
    const MeasuredLine along(line);
    for (const Stretch& stretch : find_parking_stretches(way, along, line.size(), junctions)) {
      add_lines(lane, stretch, along, painter);
      if (!is_inside) continue;
      for (auto& strip : make_strips(along.cut(stretch.first, stretch.second),
                                     lane.edge_m - bay_line_m / 2, lane.edge_m + bay_line_m / 2))
        painter.add("line along a parking lane", std::move(strip));
    }
  }
}

}  // namespace nightcity::ground_cover
