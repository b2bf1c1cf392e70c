#include "tools/barriers/find_barriers.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "formats/error.h"
#include "tools/barriers/ground_line.h"
#include "tools/barriers/measured_way.h"
#include "tools/barriers/obstacles.h"
#include "tools/barriers/openings.h"
#include "tools/ground_cover/clip_segment.h"
#include "tools/mesh/partition.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/tag_values.h"

namespace nightcity::barriers {
namespace {

using ground_cover::Box;

// Ground between the points of a 10 m grid is flat enough (as for draped streets).
constexpr double max_edge_m = 10;

const char* const stub = "thicker than long, aslant beside a house or a kerb";
const char* const drawn_twice = "along a barrier that stands there";
const char* const too_long = "beyond the first 4000 km";

class Builder {
 public:
  Builder(const osm::OsmData& map, const ground_cover::Cover& cover, const Box& bounds,
          const place::LonLatToFrame& to_frame, const place::HeightAt& height_at,
          const place::InsideBuilding& inside)
      : openings_(map),
        obstacles_(cover, height_at, inside),
        bounds_(bounds),
        to_frame_(to_frame),
        height_at_(height_at) {}

  void add(const osm::OsmWay& way) {
    const char* reason = nullptr;
    const auto design = read_design(way.tags, reason);
    const MeasuredWay line = measure(way, to_frame_, openings_, design ? design->kind.width_m : 0);
    kind_ = &find_kind(osm::find_tag(way.tags, "barrier"));
    ++kind_->ways;
    kind_->mapped_m += line.length_m();
    if (!design) return leave_out(reason, line.length_m());
    count_assumed(*design);
    design_ = design->kind;
    const bool is_area = osm::says_area(way.tags);
    if (!is_area || !line.is_closed() || design_.width_m == 0 || !add_area(line)) add_line(line);
  }

  BarrierSet take() { return std::move(set_); }

 private:
  BarrierReport::Kind& find_kind(const std::string& value) {
    static const std::set<std::string> others{"kerb", "bollard",  "chain", "handrail",
                                              "gate", "entrance", "yes"};
    const auto rows = barrier_kinds();
    const bool known =
        others.contains(value) ||
        std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return row.value == value; });
    return set_.report.kinds[known ? value : "other"];
  }

  void count_assumed(const BarrierDesign& design) {
    auto& assumed = set_.report.assumed;
    if (design.assumed_height) ++assumed["height"];
    if (design.assumed_width) ++assumed["width"];
    if (design.assumed_material) ++assumed["material"];
  }

  void leave_out(const char* reason, double length_m) {
    if (length_m > 0) set_.report.left_out_m[reason] += length_m;
  }

  // Returns whether another barrier stands along the segment, and remembers it.
  bool is_taken(const glm::dvec2& a, const glm::dvec2& b) {
    const auto to_mm = [](const glm::dvec2& p) {
      return std::pair(std::round(p.x * 1000), std::round(p.y * 1000));
    };
    return !segments_.insert(std::minmax(to_mm(a), to_mm(b))).second;
  }

  void add_line(const MeasuredWay& line) {
    const std::size_t first_run = set_.lines.size();
    set_.report.openings += line.openings_m.size();
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) add_segment(line, i);
    end_run();
    if (line.is_closed()) close(first_run, line);
  }

  void add_segment(const MeasuredWay& line, std::size_t i) {
    const glm::dvec2 &a = line.points[i], &b = line.points[i + 1];
    const double length_m = line.at_m[i + 1] - line.at_m[i];
    if (!(length_m > 0)) return;
    const auto within = ground_cover::clip_segment(a, b, bounds_);
    const char* reason = nullptr;
    if (!within)
      reason = beyond_ground;
    else if (is_taken(a, b))
      reason = drawn_twice;
    else if (length_m_ >= max_length_m)
      reason = too_long;
    if (reason) {
      end_run();
      return leave_out(reason, length_m);
    }
    const double from_m = within->first * length_m, to_m = within->second * length_m;
    leave_out(beyond_ground, length_m - (to_m - from_m));
    if (from_m > 0) end_run();
    length_m_ += to_m - from_m;
    for (const Stretch& part : obstacles_.find_stretches(line, i, from_m, to_m)) {
      if (part.obstacle) {
        end_run();
        leave_out(part.obstacle, part.to_m - part.from_m);
        continue;
      }
      const auto at = [&](double s) { return glm::mix(a, b, s / length_m); };
      extend_run(at(part.from_m), at(part.to_m), part.to_m == to_m);
      kind_->built_m += part.to_m - part.from_m;
    }
    if (to_m < length_m) end_run();
  }

  void extend_run(const glm::dvec2& from, const glm::dvec2& to, bool is_corner) {
    if (run_.empty()) run_.push_back(from);
    run_end_ = to;
    if (is_corner || glm::distance(run_.back(), to) > max_edge_m - step_m) run_.push_back(to);
  }

  void end_run() {
    if (run_.empty()) return;
    if (run_.back() != run_end_) run_.push_back(run_end_);
    drop_short_end();
    if (auto points = put_on_ground(run_, height_at_); points.size() > 1) {
      BarrierLine line{design_, std::move(points)};
      if (design_.width_m > 0) fit_ends(line);
      if (const double stub_m = find_stub_m(line); stub_m > 0) {
        kind_->built_m -= stub_m;
        leave_out(stub, stub_m);
      } else {
        set_.lines.push_back(std::move(line));
      }
    }
    run_.clear();
  }

  // Returns the length of a line of which one side ends before it begins; 0 of others.
  static double find_stub_m(const BarrierLine& line) {
    if (line.points.size() != 2) return 0;
    const double length_m = glm::distance(glm::dvec2(line.points[0]), glm::dvec2(line.points[1]));
    const auto& [first, last] = line.ends;
    const double shorter_side_m =
        length_m + std::min(last.left_m + first.right_m, last.right_m + first.left_m);
    return shorter_side_m > 0 ? 0 : length_m;
  }

  // Joins the last two segments of a run where they are one straight line and the last is short,
  // so that its sides may end anywhere on it.
  void drop_short_end() {
    if (run_.size() < 3) return;
    const glm::dvec2 &a = run_[run_.size() - 3], &b = run_[run_.size() - 2], &c = run_.back();
    const glm::dvec2 along = c - a, half = b - a;
    constexpr double straight_m = 1e-6;
    if (glm::distance(b, c) < max_edge_m / 2 &&
        std::abs(along.x * half.y - along.y * half.x) <= straight_m * glm::length(along))
      run_.erase(run_.end() - 2);
  }

  void fit_ends(BarrierLine& line) const {
    const auto blocks = [&](const glm::dvec2& place) { return obstacles_.blocks(place); };
    const auto fit = [&](const glm::dvec3& end, const glm::dvec3& before) {
      const glm::dvec2 along = glm::dvec2(end) - glm::dvec2(before);
      const double length_m = glm::length(along);
      return length_m > 0
                 ? find_end(glm::dvec2(end), along / length_m, design_.width_m, length_m, blocks)
                 : BarrierEnd();
    };
    const std::vector<glm::dvec3>& points = line.points;
    line.ends[0] = fit(points[0], points[1]);
    line.ends[1] = fit(points.back(), points[points.size() - 2]);
  }

  // Joins the first and the last run of a closed way, which is cut at its first point.
  void close(std::size_t first_run, const MeasuredWay& line) {
    if (set_.lines.size() <= first_run) return;
    BarrierLine &first = set_.lines[first_run], &last = set_.lines.back();
    const glm::dvec2& seam = line.points.front();
    if (glm::dvec2(first.points.front()) != seam || glm::dvec2(last.points.back()) != seam) return;
    if (&first == &last) {
      first.closed = first.points.size() > 3;
      if (first.closed) {
        first.points.pop_back();
        first.ends[0] = first.ends[1] = {};
      }
      return;
    }
    last.points.insert(last.points.end(), first.points.begin() + 1, first.points.end());
    last.ends[1] = first.ends[1];
    set_.lines.erase(set_.lines.begin() + static_cast<std::ptrdiff_t>(first_run));
  }

  // Adds an area whose outline is free all along; returns whether it was.
  bool add_area(const MeasuredWay& line) {
    std::vector<glm::dvec2> ring;
    if (line.length_m() > max_area_outline_m || length_m_ >= max_length_m) return false;
    length_m_ += line.length_m();
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
      const glm::dvec2 &a = line.points[i], &b = line.points[i + 1];
      if (!bounds_.holds(a)) return false;
      const double steps = std::max(1.0, std::ceil(glm::distance(a, b) / step_m));
      for (double k = 0; k < steps; ++k) {
        const glm::dvec2 p = glm::mix(a, b, k / steps);
        if (obstacles_.find(p)) return false;
        if (k == 0 || glm::distance(ring.back(), p) > max_edge_m - step_m) ring.push_back(p);
      }
    }
    BarrierArea area{design_, {}, {}};
    if (!fill(ring, area)) return false;
    set_.areas.push_back(std::move(area));
    ++set_.report.areas;
    kind_->built_m += line.length_m();
    return true;
  }

  bool fill(const std::vector<glm::dvec2>& ring, BarrierArea& area) const {
    const mesh::PlaneLayer layer{{{ring}, 0}};
    try {
      const mesh::PlanePartition plan = mesh::partition({&layer, 1});
      area.points = put_on_ground(plan.points, height_at_);
      for (const auto& triangle : plan.triangles) area.triangles.push_back(triangle.vertex);
    } catch (const Error&) {  // its outline crosses itself too often
      return false;
    }
    return !area.triangles.empty() && !area.points.empty();
  }

  static constexpr double max_area_outline_m = 10'000;

  Openings openings_;
  Obstacles obstacles_;
  const Box& bounds_;
  const place::LonLatToFrame& to_frame_;
  const place::HeightAt& height_at_;
  BarrierSet set_;
  BarrierReport::Kind* kind_ = nullptr;  // of the present way
  BarrierKind design_{};                 // of the present way
  std::vector<glm::dvec2> run_;
  glm::dvec2 run_end_{0};
  double length_m_ = 0;  // that was looked at
  using Place = std::pair<double, double>;
  std::set<std::pair<Place, Place>> segments_;
};

}  // namespace

BarrierSet find_barriers(const osm::OsmData& map, const ground_cover::Cover& cover,
                         const ground_cover::Box& bounds, const place::LonLatToFrame& to_frame,
                         const place::HeightAt& height_at, const place::InsideBuilding& inside) {
  std::vector<const osm::OsmWay*> ways;
  for (const osm::OsmWay& way : map.barriers) ways.push_back(&way);
  // The most solid come first, then the higher and the wider ones, whatever their order in the map.
  const auto key = [](const osm::OsmWay* way) {
    const auto kinds = barrier_kinds();
    const std::string value = osm::find_tag(way->tags, "barrier");
    const auto row = std::find_if(kinds.begin(), kinds.end(),
                                  [&](const BarrierKind& kind) { return kind.value == value; });
    const char* reason = nullptr;
    const BarrierDesign design = read_design(way->tags, reason).value_or(BarrierDesign());
    return std::tuple(row - kinds.begin(), -design.kind.height_m, -design.kind.width_m);
  };
  std::stable_sort(ways.begin(), ways.end(),
                   [&](const auto* a, const auto* b) { return key(a) < key(b); });
  Builder builder(map, cover, bounds, to_frame, height_at, inside);
  for (const osm::OsmWay* way : ways) builder.add(*way);
  return builder.take();
}

}  // namespace nightcity::barriers
