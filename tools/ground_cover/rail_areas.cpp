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
#include "tools/osm/osm_selection.h"
#include "tools/osm/tag_values.h"

namespace nightcity::ground_cover {
namespace {

// A track is looked at this often to see what it runs in.
constexpr double step_m = 2;
// A stretch that is shorter than this is a crossing, or a gap between carriageways. An assumption:
// a street with a carriageway each way is not as wide.
constexpr double min_stretch_m = 20;
// A hostile map gets no more tracks than this, as it gets no more barriers.
constexpr double max_length_m = 4e6;
// Trams run in squares too, which are areas of land of this rank and above.
constexpr int square_land_rank = 700;

enum class Place { open, pavement, street };

// A part of a line, by distances from its start.
struct TrackStretch {
  double from_m, to_m;
  Place place;
  double length_m() const { return to_m - from_m; }
};

// Finds the areas of streets among those of a cover.
class Streets {
 public:
  explicit Streets(const Cover& cover) : cover_(cover) {
    for (std::uint32_t i = 0; i < cover.areas().size(); ++i) {
      const CoverArea& area = cover.areas()[i];
      if (area.rank < square_land_rank || area.rank == platform_rank || !can_be_indexed(area))
        continue;
      boxes_.emplace(i, find_box(area.rings));
      index_.add(i, boxes_.at(i));
    }
  }
  // Returns what a place lies in. A street is an area of `min_rank` or a greater one that is no
  // pavement beside a carriageway.
  Place find(const glm::dvec2& place, int min_rank) const {
    Place found = Place::open;
    for (const std::uint32_t i : index_.find({place, place})) {
      const CoverArea& area = cover_.areas()[i];
      if (!boxes_.at(i).holds(place) || !mesh::holds(area.rings, place)) continue;
      if (area.rank == pavement_rank)
        found = Place::pavement;
      else if (area.rank >= min_rank)
        return Place::street;
    }
    return found;
  }

 private:
  static bool can_be_indexed(const CoverArea& area) {
    const auto is_near = [](const glm::dvec2& p) {
      return std::max(std::abs(p.x), std::abs(p.y)) < 1e8;
    };
    return !area.rings.empty() &&
           std::all_of(area.rings.begin(), area.rings.end(), [&](const Ring& ring) {
             return !ring.empty() && std::all_of(ring.begin(), ring.end(), is_near);
           });
  }

  const Cover& cover_;
  std::map<std::uint32_t, Box> boxes_;
  BoxIndex index_;
};

// Adds a stretch behind others, to the last where that lies in the same kind of place. Between two
// with a gap between them the line leaves the ground.
void append(std::vector<TrackStretch>& stretches, const TrackStretch& next) {
  constexpr double gap_m = 1e-3;
  if (!stretches.empty() && stretches.back().place == next.place &&
      next.from_m - stretches.back().to_m < gap_m)
    stretches.back().to_m = next.to_m;
  else
    stretches.push_back(next);
}

// Gives short stretches within a line the place of the longer of their neighbours.
std::vector<TrackStretch> drop_short(const std::vector<TrackStretch>& stretches) {
  std::vector<TrackStretch> kept;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    TrackStretch stretch = stretches[i];
    if (i > 0 && i + 1 < stretches.size() && stretch.length_m() < min_stretch_m) {
      const TrackStretch &before = kept.back(), &after = stretches[i + 1];
      stretch.place = (before.length_m() >= after.length_m() ? before : after).place;
    }
    append(kept, stretch);
  }
  return kept;
}

class RailAreas {
 public:
  RailAreas(const place::LonLatToFrame& to_frame, const Box& bounds, Cover& cover)
      : to_frame_(to_frame), bounds_(bounds), cover_(cover), streets_(cover) {}

  void add(const osm::OsmWay& way) {
    const TrackKind* kind = find_track_kind(osm::find_tag(way.tags, "railway"));
    if (!kind || osm::says_area(way.tags)) return;
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
    for (const TrackStretch& stretch : find_stretches(line, along, tracks))
      add(tracks, along.cut(stretch.from_m, stretch.to_m), stretch.place);
  }

 private:
  std::vector<TrackStretch> find_stretches(const std::vector<glm::dvec2>& line,
                                           const MeasuredLine& along, const Tracks& tracks) const {
    // Below a bridge, paths and squares are not what it carries.
    const int min_rank =
        tracks.kind->uses_streets && !tracks.elevated ? square_land_rank : carriageway_end_rank;
    std::vector<TrackStretch> stretches;
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
        append(stretches, {a, b, streets_.find(place, min_rank)});
      }
    }
    return drop_short(stretches);
  }

  void add(const Tracks& tracks, const std::vector<glm::dvec2>& line, Place where) {
    // A carriageway may be wider than the map says: trams beside it run in its street, unless a tag
    // gives them a bed.
    const bool says_bed = tracks.bed && !tracks.bed->assumed;
    const bool in_street = where == Place::street ||
                           (where == Place::pavement && tracks.kind->uses_streets && !says_bed);
    const double length_m = find_length_m(line, bounds_);
    if (tracks.elevated && !(in_street && tracks.kind->uses_streets)) {
      cover_.left_out_m["tracks on a bridge that carries no street"] += length_m;
      return;
    }
    const bool has_bed = tracks.bed && !in_street;
    const std::string place = in_street ? "in a street"
                              : has_bed ? std::string("on ") + find_material(tracks.bed->kind).name
                                        : "embedded";
    cover_.tracks_m[std::string(tracks.kind->railway) + " " + place] += length_m;
    if (has_bed) add_bed(tracks, line, where == Place::pavement);
    for (int track = 0; track < tracks.count; ++track)
      for (const double right_m : tracks.find_rails()) {
        const double from_m = tracks.middle_m(track) + right_m;
        for (auto& strip : make_strips(line, from_m, from_m + rail_head_m))
          cover_.add_marking(std::move(strip), Marking::rail);
      }
  }

  void add_bed(const Tracks& tracks, const std::vector<glm::dvec2>& line, bool on_pavement) {
    const int rank = on_pavement ? bed_along_pavement_rank : bed_rank;
    if (tracks.bed->assumed) ++cover_.assumed["ballast under a track"];
    const double gauge_m = tracks.gauges_m.back();
    const double width_m =
        (on_pavement ? TrackBed::paved_width_m(gauge_m) : tracks.bed->width_m(gauge_m)) +
        (tracks.count - 1) * tracks.kind->spacing_m;
    std::vector<Ring> rings = widener_.widen(line, width_m / 2);
    if (!rings.empty()) cover_.add({rank, {tracks.bed->kind, false, false}, std::move(rings)});
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
