// Paint on carriageways: bars of crossings and lines between lanes.
#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "tools/ground_cover/street_areas.h"
#include "tools/ground_cover/way_line.h"
#include "tools/roads/carriageway.h"

namespace nightcity::ground_cover {
namespace {

// StVO, sign 293 and RMS-1: bars of 0.50 m, as far apart, at least 3 m long (4 m as a rule).
constexpr double bar_m = 0.5, bar_length_m = 4;
// RMS-1: in towns a line between lanes is 0.12 m wide, 3 m long, with gaps of 6 m.
constexpr double line_width_m = 0.12, dash_m = 3, gap_m = 6;
// Lines end this far before a junction, so that they stay out of it: half a wide carriageway.
constexpr double junction_m = 10;

// A city of a million people has some 300,000 dashes. A hostile map gets no more than this.
constexpr std::size_t max_markings = 4'000'000;

// Adds markings as far as they lie within bounds, until there are too many.
class Painter {
 public:
  Painter(const Box& bounds, Cover& cover) : bounds_(bounds), cover_(cover) {}
  bool is_done() const { return tried_ >= max_markings; }
  void add(std::vector<glm::dvec2> strip) {
    if (++tried_ == max_markings) ++cover_.left_out["markings beyond the first 4000000"];
    if (!is_done() && bounds_.holds(strip.front())) cover_.add_marking(std::move(strip));
  }

 private:
  const Box& bounds_;
  Cover& cover_;
  std::size_t tried_ = 0;
};

// A line with the distance of each point from its start.
class Measured {
 public:
  explicit Measured(const std::vector<glm::dvec2>& line) : line_(line), at_m_{0} {
    for (std::size_t i = 1; i < line.size(); ++i)
      at_m_.push_back(at_m_.back() + glm::distance(line[i - 1], line[i]));
  }
  double length_m() const { return at_m_.back(); }
  double at(std::size_t i) const { return at_m_[i]; }

  // Returns the corners of a strip from `from_m` to `to_m` along the line, between two distances to
  // its left. A strip is straight: a bend within it becomes its chord.
  std::vector<glm::dvec2> make_strip(double from_m, double to_m, double right_m,
                                     double left_m) const {
    const auto [a, along_a] = find(from_m);
    const auto [b, along_b] = find(to_m);
    const glm::dvec2 left_a(-along_a.y, along_a.x), left_b(-along_b.y, along_b.x);
    return {a + left_a * right_m, b + left_b * right_m, b + left_b * left_m, a + left_a * left_m};
  }

 private:
  std::pair<glm::dvec2, glm::dvec2> find(double s) const {
    const auto next = std::lower_bound(at_m_.begin() + 1, at_m_.end() - 1, s);
    const auto i = static_cast<std::size_t>(next - at_m_.begin());
    const double length = at_m_[i] - at_m_[i - 1];
    if (!(length > 0)) return {line_[i], {1, 0}};
    const glm::dvec2 along = (line_[i] - line_[i - 1]) / length;
    return {line_[i - 1] + along * (s - at_m_[i - 1]), along};
  }

  const std::vector<glm::dvec2>& line_;
  std::vector<double> at_m_;
};

bool is_marked_crossing(const osm::OsmTags& tags) {
  if (tag_of(tags, "footway") != "crossing" && tag_of(tags, "path") != "crossing") return false;
  const std::string markings = tag_of(tags, "crossing:markings"), kind = tag_of(tags, "crossing");
  if (!markings.empty()) return markings == "zebra" || markings.starts_with("zebra:");
  return kind == "zebra" || kind == "marked" || kind == "uncontrolled" ||
         tag_of(tags, "crossing_ref") == "zebra";
}

// Places where drivable ways meet, by their coordinates as written.
class Junctions {
 public:
  void add(const osm::OsmWay& way) {
    for (std::size_t i = 0; i < way.lon_lat.size(); ++i) {
      const bool at_end = i == 0 || i + 1 == way.lon_lat.size();
      arms_[{way.lon_lat[i].x, way.lon_lat[i].y}] += at_end ? 1 : 2;
    }
  }
  bool holds(const glm::dvec2& p) const {
    const auto found = arms_.find({p.x, p.y});
    return found != arms_.end() && found->second > 2;
  }

 private:
  std::map<std::pair<double, double>, int> arms_;
};

bool is_drivable(const std::optional<roads::Carriageway>& road) {
  return road && road->lanes[0] + road->lanes[1] > 0;
}

// Roads of towns have lines between lanes from tertiary roads upwards, unless the map says no.
bool has_lane_lines(const roads::Carriageway& road, const osm::OsmTags& tags) {
  constexpr int lowest_rank = 4;
  return road.lanes[0] + road.lanes[1] > 1 && road.road_class->rank >= lowest_rank &&
         tag_of(tags, "lane_markings") != "no";
}

void add_lane_lines(const osm::OsmWay& way, const roads::Carriageway& road,
                    const std::vector<glm::dvec2>& line, const Junctions& junctions,
                    Painter& painter) {
  if (line.size() != way.lon_lat.size()) return;
  const Measured along(line);
  const int lanes = road.lanes[0] + road.lanes[1];
  const double edge_m = -lanes * road.lane_m() / 2;
  std::vector<double> junctions_m;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (junctions.holds(way.lon_lat[i])) junctions_m.push_back(along.at(i));
  for (double s = gap_m / 2; s + dash_m <= along.length_m() && !painter.is_done();
       s += dash_m + gap_m) {
    const auto next = std::lower_bound(junctions_m.begin(), junctions_m.end(), s - junction_m);
    const bool free = next == junctions_m.end() || *next > s + dash_m + junction_m;
    for (int lane = 1; free && lane < lanes; ++lane) {
      const double middle_m = edge_m + lane * road.lane_m();
      painter.add(along.make_strip(s, s + dash_m, middle_m - line_width_m / 2,
                                   middle_m + line_width_m / 2));
    }
  }
}

}  // namespace

void add_markings(std::span<const osm::OsmWay> ways, const place::LonLatToFrame& to_frame,
                  const Box& bounds, Cover& cover) {
  Painter painter(bounds, cover);
  Junctions junctions;
  for (const osm::OsmWay& way : ways)
    if (is_drivable(roads::read_carriageway(way.tags))) junctions.add(way);
  for (const osm::OsmWay& way : ways) {
    const auto road = roads::read_carriageway(way.tags);
    const bool crossing = is_marked_crossing(way.tags);
    if (!crossing && !(is_drivable(road) && has_lane_lines(*road, way.tags))) continue;
    const std::vector<glm::dvec2> line = find_line(way.lon_lat, to_frame, bounds);
    if (line.size() < 2) continue;
    if (!crossing) {
      add_lane_lines(way, *road, line, junctions, painter);
      continue;
    }
    const Measured along(line);
    for (double s = 0; s + bar_m <= along.length_m() && !painter.is_done(); s += 2 * bar_m)
      painter.add(along.make_strip(s, s + bar_m, -bar_length_m / 2, bar_length_m / 2));
  }
}

}  // namespace nightcity::ground_cover
