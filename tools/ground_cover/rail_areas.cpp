#include "tools/ground_cover/rail_areas.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tools/ground_cover/clip_segment.h"
#include "tools/ground_cover/measured_line.h"
#include "tools/ground_cover/street_areas.h"
#include "tools/ground_cover/tracks.h"
#include "tools/ground_cover/way_line.h"
#include "tools/ground_cover/widened_line.h"
#include "tools/mesh/owner_finder.h"

namespace nightcity::ground_cover {
namespace {

// A track is looked at this often to see whether it runs in a street.
constexpr double step_m = 2;
// A stretch that is shorter than this is a crossing, or a gap between carriageways. An assumption:
// a street with a carriageway each way is not as wide.
constexpr double min_stretch_m = 20;
// A hostile map gets no more tracks than this, as it gets no more barriers.
constexpr double max_length_m = 4e6;
// Trams run in squares too, which are areas of land of this rank and above.
constexpr int square_land_rank = 700;

// A part of a line, by distances from its start, in a street or not.
struct Stretch {
  double from_m, to_m;
  bool in_street;
};

// Finds the areas of streets among those of a cover.
class Streets {
 public:
  explicit Streets(const Cover& cover) : cover_(cover) {
    for (std::uint32_t i = 0; i < cover.areas().size(); ++i) {
      const CoverArea& area = cover.areas()[i];
      if (area.rank < square_land_rank || is_platform(area) || !is_finite(area)) continue;
      boxes_.emplace(i, find_box(area.rings));
      index_.add(i, boxes_.at(i));
    }
  }
  // Returns whether an area of this rank or a greater one holds a place.
  bool hold(const glm::dvec2& place, int min_rank) const {
    for (const std::uint32_t i : index_.find({place, place})) {
      const CoverArea& area = cover_.areas()[i];
      if (area.rank >= min_rank && boxes_.at(i).holds(place) && mesh::holds(area.rings, place))
        return true;
    }
    return false;
  }

 private:
  static bool is_platform(const CoverArea& area) {
    return area.rank > bed_rank && area.rank < square_rank;
  }
  static bool is_finite(const CoverArea& area) {
    const auto near = [](const glm::dvec2& p) {
      return std::max(std::abs(p.x), std::abs(p.y)) < 1e8;
    };
    return !area.rings.empty() &&
           std::all_of(area.rings.begin(), area.rings.end(), [&](const Ring& ring) {
             return !ring.empty() && std::all_of(ring.begin(), ring.end(), near);
           });
  }

  const Cover& cover_;
  std::map<std::uint32_t, Box> boxes_;
  BoxIndex index_;
};

// Joins neighbours of one kind. Those with a gap between them lie on both sides of a place where the
// line leaves the ground.
std::vector<Stretch> join(const std::vector<Stretch>& stretches) {
  constexpr double gap_m = 1e-3;
  std::vector<Stretch> joined;
  for (const Stretch& stretch : stretches)
    if (!joined.empty() && joined.back().in_street == stretch.in_street &&
        stretch.from_m - joined.back().to_m < gap_m)
      joined.back().to_m = stretch.to_m;
    else
      joined.push_back(stretch);
  return joined;
}

// Gives short stretches within a line the kind of their neighbours.
void drop_short(std::vector<Stretch>& stretches, bool in_street) {
  for (std::size_t i = 1; i + 1 < stretches.size(); ++i)
    if (stretches[i].in_street == in_street &&
        stretches[i].to_m - stretches[i].from_m < min_stretch_m)
      stretches[i].in_street = !in_street;
  stretches = join(stretches);
}

class RailAreas {
 public:
  RailAreas(const place::LonLatToFrame& to_frame, const Box& bounds, Cover& cover)
      : to_frame_(to_frame), bounds_(bounds), cover_(cover), streets_(cover) {}

  void add(const osm::OsmWay& way) {
    const TrackKind* kind = find_track_kind(tag_of(way.tags, "railway"));
    if (!kind || tag_of(way.tags, "area") == "yes") return;
    std::vector<glm::dvec2> line = find_line(way.lon_lat, to_frame_, bounds_);
    line.erase(std::unique(line.begin(), line.end()), line.end());
    const double length_m = find_length_m(line, bounds_);
    if (!(length_m > 0)) return;
    if (const std::string reason = find_reason_to_leave_out(way.tags, *kind); !reason.empty()) {
      cover_.left_out_m[reason] += length_m;
      return;
    }
    if ((length_m_ += length_m) > max_length_m) {
      cover_.left_out_m["tracks beyond the first 4000 km"] += length_m;
      return;
    }
    const Tracks tracks = read_tracks(way.tags, *kind);
    if (tracks.gauge_assumed) ++cover_.assumed["gauge of a track"];
    if (tracks.gauge_refused) ++cover_.assumed["gauge of a track whose tag makes no sense"];
    const MeasuredLine along(line);
    for (const Stretch& stretch : find_stretches(line, along, *kind))
      add(tracks, along.cut(stretch.from_m, stretch.to_m), stretch.in_street);
  }

 private:
  std::vector<Stretch> find_stretches(const std::vector<glm::dvec2>& line,
                                      const MeasuredLine& along, const TrackKind& kind) const {
    const int min_rank = kind.uses_streets ? square_land_rank : carriageway_rank;
    std::vector<Stretch> stretches;
    for (std::size_t i = 1; i < line.size(); ++i) {
      const auto within = clip_segment(line[i - 1], line[i], bounds_);
      if (!within) continue;
      const double start_m = along.at(i - 1), length_m = along.at(i) - start_m;
      const double from_m = start_m + within->first * length_m,
                   to_m = start_m + within->second * length_m;
      const double steps = std::ceil((to_m - from_m) / step_m);
      for (double step = 0; step < steps; ++step) {
        const double a = from_m + (to_m - from_m) * step / steps,
                     b = from_m + (to_m - from_m) * (step + 1) / steps;
        const double share = ((a + b) / 2 - start_m) / length_m;
        const glm::dvec2 place = line[i - 1] + (line[i] - line[i - 1]) * share;
        stretches.push_back({a, b, streets_.hold(place, min_rank)});
      }
    }
    stretches = join(stretches);
    drop_short(stretches, false);
    drop_short(stretches, true);
    return stretches;
  }

  void add(const Tracks& tracks, const std::vector<glm::dvec2>& line, bool in_street) {
    const double length_m = find_length_m(line, bounds_);
    if (tracks.elevated && !in_street) {
      cover_.left_out_m["tracks on a bridge that carries no street"] += length_m;
      return;
    }
    const bool has_bed = tracks.bed && !in_street;
    const std::string place = in_street ? "in a street"
                              : has_bed ? std::string("on ") + find_material(tracks.bed->kind).name
                                        : "embedded";
    cover_.tracks_m[std::string(tracks.kind->railway) + " " + place] += length_m;
    if (has_bed) add_bed(tracks, line);
    for (int track = 0; track < tracks.count; ++track)
      for (const double right_m : tracks.find_rails()) {
        const double from_m = tracks.middle_m(track) + right_m;
        for (auto& strip : make_strips(line, from_m, from_m + rail_head_m))
          cover_.add_marking(std::move(strip), Marking::rail);
      }
  }

  void add_bed(const Tracks& tracks, const std::vector<glm::dvec2>& line) {
    if (tracks.bed->assumed) ++cover_.assumed["ballast under a track"];
    const double width_m =
        tracks.bed->width_m(tracks.gauges_m.back()) + (tracks.count - 1) * tracks.kind->spacing_m;
    std::vector<Ring> rings = widener_.widen(line, width_m / 2);
    if (!rings.empty()) cover_.add({bed_rank, {tracks.bed->kind, false, false}, std::move(rings)});
  }

  const place::LonLatToFrame& to_frame_;
  const Box& bounds_;
  Cover& cover_;
  Streets streets_;
  Widener widener_;
  double length_m_ = 0;
};

}  // namespace

void add_rails(std::span<const osm::OsmWay> railways, const place::LonLatToFrame& to_frame,
               const Box& bounds, Cover& cover) {
  if (railways.empty()) return;
  RailAreas rails(to_frame, bounds, cover);
  for (const osm::OsmWay& way : railways) rails.add(way);
}

}  // namespace nightcity::ground_cover
