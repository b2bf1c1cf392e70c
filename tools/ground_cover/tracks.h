// The tracks of a railway's way, as its tags say.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/ground_cover/ground_kind.h"
#include "tools/osm/osm_data.h"

namespace nightcity::ground_cover {

/// Width of a rail's head, m (EN 13674-1, profile 60 E1: 72 mm). The groove of tram rails, and the
/// lip beside it, are not modelled.
constexpr double rail_head_m = 0.072;

struct TrackKind {
  std::string_view railway;  // value of the OSM tag
  double gauge_m;            // where no tag says otherwise; 0: such a railway has no two rails here
  double spacing_m;          // between the middles of two tracks that lie side by side
  bool uses_streets;         // it may run in squares and on pavements, and not only on carriageways
};

/// Returns the row of a normalised value of `railway`; null where it is no track.
const TrackKind* find_track_kind(std::string_view railway);

/// The bed of a track that runs in no street.
struct TrackBed {
  GroundKind kind = GroundKind::ballast;
  bool assumed = false;  // no tag says so
  /// Returns the width in metres of the bed of one track, and of one that runs along a pavement or
  /// platform.
  double width_m(double gauge_m) const;
  static double paved_width_m(double gauge_m);
};

struct Tracks {
  const TrackKind* kind = nullptr;
  /// Between the inner faces of rails, m, ascending; several gauges share their right rail.
  std::vector<double> gauges_m;
  bool gauge_assumed = false, gauge_refused = false;  // a tag that makes no sense was refused
  int count = 1;                                      // side by side
  std::optional<TrackBed> bed;                        // none: embedded in what lies there
  bool elevated = false;                              // on a bridge

  /// Returns the distance in metres of a track's middle from the way, to its left.
  double middle_m(int track) const;
  /// Returns the distances in metres of the right edges of a track's rails from its middle, to the
  /// left.
  std::vector<double> find_rails() const;
};

/// Returns why nothing of a way with these tags lies on the ground: in words for a report, or ""
/// where something does. `kind`: of its tag `railway`.
std::string find_reason_to_leave_out(const osm::OsmTags& tags, const TrackKind& kind);

/// Reads tags of which find_reason_to_leave_out says "".
Tracks read_tracks(const osm::OsmTags& tags, const TrackKind& kind);

}  // namespace nightcity::ground_cover
