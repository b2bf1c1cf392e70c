#include "tools/ground_cover/street_areas.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/finite.h"
#include "tools/ground_cover/bay_lines.h"
#include "tools/ground_cover/clip_segment.h"
#include "tools/ground_cover/junctions.h"
#include "tools/ground_cover/measured_line.h"
#include "tools/ground_cover/roadside.h"
#include "tools/ground_cover/way_line.h"
#include "tools/ground_cover/widened_line.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/tag_values.h"
#include "tools/roads/carriageway.h"
#include "tools/roads/parking_lane.h"

namespace nightcity::ground_cover {
namespace {

using Side = Widener::Side;

// Returns what a road is made of where its tag `surface` does not say. OSM wiki, "Key:surface":
// streets of towns are asphalt, and tracks are not. Paths in towns are paved with stones (RASt 06,
// 6.1.6.6).
GroundKind guess_surface(const osm::OsmTags& tags, const roads::RoadClass& road) {
  const std::string_view highway = road.highway;
  if (highway == "track") {
    // OSM wiki, "Key:tracktype": 1 is sealed, 2 and 3 hold stones, 4 is mostly soft, 5 overgrown.
    const std::string grade = osm::find_tag(tags, "tracktype");
    if (grade == "grade1") return GroundKind::asphalt;
    if (grade == "grade4") return GroundKind::soil;
    return grade == "grade5" ? GroundKind::grass : GroundKind::gravel;
  }
  if (highway == "path" || highway == "bridleway") return GroundKind::soil;
  if (highway == "cycleway") return GroundKind::asphalt;
  return road.tier == roads::RoadTier::path ? GroundKind::paving_stones : GroundKind::asphalt;
}

// Makes room for the cars that park along one side.
void add_parking(const roads::ParkingLane& lane, Roadside& side) {
  side.parking = lane;
  if (lane.place == roads::ParkingPlace::street_side)
    side.bay_m = lane.beyond_edge_m();
  else
    side.pavement_m = std::max(side.pavement_m, lane.beyond_edge_m());
}

// A way that is below ground on all its levels. A layer alone only says what crosses above what:
// a street in a cutting lies open.
bool lies_below(const osm::OsmTags& tags, const char* key) {
  const auto found = tags.find(key);
  if (found == tags.end()) return false;
  bool below = false;
  for (std::string_view part : osm::split_list(found->second)) {
    const auto number = osm::take_number(part);
    if (!number || *number >= 0 || !part.empty()) return false;
    below = true;
  }
  return below;
}

class StreetAreas {
 public:
  StreetAreas(std::span<const osm::OsmWay> ways, bool bays, const place::LonLatToFrame& to_frame,
              const Box& bounds, Cover& cover)
      : bays_(bays), to_frame_(to_frame), bounds_(bounds), cover_(cover) {
    // Few maps have bays, and the junctions of all streets take time to find.
    if (bays && std::any_of(ways.begin(), ways.end(), has_bays)) junctions_.emplace(ways);
  }

  void add(const osm::OsmWay& way) {
    const auto carriageway = roads::read_carriageway(way.tags);
    const std::vector<glm::dvec2> line = find_line(way.lon_lat, to_frame_, bounds_);
    if (!carriageway) count_unknown(way.tags, line);
    if (!carriageway || line.size() < 2) return;
    if (lies_inside(way.tags)) {
      ++cover_.left_out["street in a tunnel or a building"];
      return;
    }
    if (osm::says_area(way.tags)) return;  // an outline, which add_land takes
    count_earthworks(way.tags, line);
    const roads::RoadClass& road = *carriageway->road_class;
    const GroundKind kind = find_kind(way.tags, road);
    const double half_m = carriageway->width_m / 2;
    size_ = {half_m, find_length_m(line, bounds_)};
    if (road.tier == roads::RoadTier::path) {
      const bool sunken = false, marked = false;
      add(line, half_m, Side::both, path_rank, {kind, sunken, marked});
      return;
    }
    if (carriageway->is_widened) ++cover_.assumed["width of a street on which cars park"];
    add_carriageway(line, half_m, road.rank, {kind, road.kerbed, true});
    Roadside left = read_roadside(way.tags, road, "left"),
             right = read_roadside(way.tags, road, "right");
    if (bays_) {
      read_parking(way.tags, "left", line, left);
      read_parking(way.tags, "right", line, right);
      add_bays(way, line, half_m, left, right, {kind, road.kerbed, true});
    }
    add_roadside(line, half_m, left, right);
    if (left.assumed || right.assumed) ++cover_.assumed["pavement beside a street"];
  }

  // The wider of two streets of one rank is seen where they cross, and the longer of two that are
  // as wide, in whatever order the map has them.
  void finish() {
    std::stable_sort(found_.begin(), found_.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (auto& [size, area] : found_) cover_.add(std::move(area));
  }

 private:
  static bool has_bays(const osm::OsmWay& way) {
    for (const char* side : {"left", "right"})
      if (const auto lane = roads::read_parking_lane(way.tags, side);
          lane && lane->place == roads::ParkingPlace::street_side)
        return true;
    return false;
  }

  // Roads for races, guided buses and runaway lorries are of no class that the table knows.
  void count_unknown(const osm::OsmTags& tags, const std::vector<glm::dvec2>& line) {
    const std::string highway = osm::find_tag(tags, "highway");
    for (const char* known : {"raceway", "bus_guideway", "escape"})
      if (highway == known) cover_.left_out_m["highway=" + highway] += find_length_m(line, bounds_);
  }

  // The map does not say how high embankments are, or how deep cuttings: a ground that is measured
  // has them, and on any other a height would be made up.
  void count_earthworks(const osm::OsmTags& tags, const std::vector<glm::dvec2>& line) {
    for (const char* key : {"embankment", "cutting"})
      if (osm::is_tagged(tags, key))
        cover_.left_out_m[std::string("slopes of a street with ") + key] +=
            find_length_m(line, bounds_);
  }

  void read_parking(const osm::OsmTags& tags, const char* name, const std::vector<glm::dvec2>& line,
                    Roadside& side) {
    if (roads::is_parking_separate(tags, name))
      cover_.left_out_m["parking lanes mapped as areas"] += find_length_m(line, bounds_);
    const auto lane = roads::read_parking_lane(tags, name);
    if (!lane) return;
    cover_.parking_m[lane->name()] += find_length_m(line, bounds_);
    if (lane->orientation_assumed) ++cover_.assumed["orientation of parked cars"];
    add_parking(*lane, side);
  }

  // Bays are of what the carriageway is of where no tag says otherwise.
  void add_bays(const osm::OsmWay& way, const std::vector<glm::dvec2>& line, double half_m,
                const Roadside& left, const Roadside& right, const Surface& carriageway) {
    if (!junctions_) return;
    const MeasuredLine along(line);
    for (const Roadside* side : {&left, &right}) {
      if (!(side->bay_m > 0)) continue;
      Surface surface = carriageway;
      surface.kind = find_surface(side->parking->surface).value_or(surface.kind);
      for (const auto& [from_m, to_m] :
           find_parking_stretches(way, along, line.size(), *junctions_))
        add(along.cut(from_m, to_m), half_m + side->bay_m, side == &left ? Side::left : Side::right,
            bay_rank, surface);
    }
  }

  GroundKind find_kind(const osm::OsmTags& tags, const roads::RoadClass& road) {
    const auto surface = tags.find("surface");
    if (surface == tags.end() || !find_surface(surface->second))
      ++cover_.assumed[surface == tags.end() ? "surface of a street"
                                             : "surface of a street whose tag is not known"];
    return find_street_surface(tags, road);
  }

  void add_roadside(const std::vector<glm::dvec2>& line, double half_m, const Roadside& left,
                    const Roadside& right) {
    // Equal sides are one area, which goes round the ends of streets that end.
    const auto add_band = [&](double left_m, double right_m, int rank, GroundKind left_kind,
                              GroundKind right_kind) {
      const Surface left_surface{left_kind, false, false}, right_surface{right_kind, false, false};
      if (left_m > 0 && left_m == right_m && left_kind == right_kind) {
        add(line, half_m + left_m, Side::both, rank, left_surface);
        return;
      }
      if (left_m > 0) add(line, half_m + left_m, Side::left, rank, left_surface);
      if (right_m > 0) add(line, half_m + right_m, Side::right, rank, right_surface);
    };
    const auto track_m = [](const Roadside& side) {
      return side.track_m > 0 ? side.bay_m + side.track_m : 0;
    };
    add_band(track_m(left), track_m(right), track_rank, left.track, right.track);
    add_band(left.pavement_m > 0 ? left.width_m() : 0, right.pavement_m > 0 ? right.width_m() : 0,
             pavement_rank, left.pavement, right.pavement);
  }

  // The round ends of streets fill the corners between them. They are seen where no carriageway
  // lies: a street that ends in a junction, or changes its class there, does not show its end.
  void add_carriageway(const std::vector<glm::dvec2>& line, double half_m, int road_rank,
                       const Surface& surface) {
    add(line, half_m, Side::both, carriageway_rank + road_rank, surface, Widener::Ends::flat);
    for (const glm::dvec2& end : {line.front(), line.back()})
      found_.emplace_back(
          size_, CoverArea{carriageway_end_rank + road_rank, surface, {make_disc(end, half_m)}});
  }

  static Ring make_disc(const glm::dvec2& middle, double radius_m) {
    constexpr int sides = 16;
    Ring ring;
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      ring.push_back(middle + radius_m * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return ring;
  }

  void add(const std::vector<glm::dvec2>& line, double distance_m, Side side, int rank,
           const Surface& surface, Widener::Ends ends = Widener::Ends::round) {
    std::vector<Ring> rings = widener_.widen(line, distance_m, side, ends);
    if (rings.empty())
      ++cover_.left_out["street without an area"];
    else
      found_.emplace_back(size_, CoverArea{rank, surface, std::move(rings)});
  }

  bool bays_;
  const place::LonLatToFrame& to_frame_;
  const Box& bounds_;
  Cover& cover_;
  std::optional<Junctions> junctions_;
  Widener widener_;
  using Size = std::pair<double, double>;  // of a street: half its width and its length, m
  Size size_{};
  std::vector<std::pair<Size, CoverArea>> found_;
};

}  // namespace

bool lies_inside(const osm::OsmTags& tags) {
  const std::string tunnel = osm::find_tag(tags, "tunnel");
  return (!tunnel.empty() && tunnel != "no" && tunnel != "building_passage") ||
         osm::find_tag(tags, "indoor") == "yes" || osm::find_tag(tags, "highway") == "corridor" ||
         osm::find_tag(tags, "location") == "underground" || lies_below(tags, "level") ||
         (lies_below(tags, "layer") && osm::is_tagged(tags, "covered"));
}

GroundKind find_street_surface(const osm::OsmTags& tags, const roads::RoadClass& road) {
  const auto surface = tags.find("surface");
  const auto kind = surface == tags.end() ? std::nullopt : find_surface(surface->second);
  return kind.value_or(guess_surface(tags, road));
}

double find_roadside_m(const osm::OsmTags& tags, const roads::RoadClass& road, const char* side) {
  const Roadside beside = read_roadside(tags, road, side);
  return beside.pavement_m > 0 ? beside.width_m() : 0;
}

double find_street_reach_m(const osm::OsmTags& tags) {
  const auto carriageway = roads::read_carriageway(tags);
  if (!carriageway) return 0;
  const roads::RoadClass& road = *carriageway->road_class;
  if (road.tier == roads::RoadTier::path) return carriageway->width_m / 2;
  double beside_m = 0;
  for (const char* side : {"left", "right"})
    beside_m = std::max(beside_m, read_roadside(tags, road, side).width_m());
  return carriageway->width_m / 2 + beside_m;
}

void add_streets(std::span<const osm::OsmWay> ways, bool bays, const place::LonLatToFrame& to_frame,
                 const Box& bounds, Cover& cover) {
  StreetAreas areas(ways, bays, to_frame, bounds, cover);
  for (const osm::OsmWay& way : ways) areas.add(way);
  areas.finish();
}

}  // namespace nightcity::ground_cover
