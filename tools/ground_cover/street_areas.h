// The streets of a map as areas: carriageways, cycle tracks, pavements, paths, and the paint on
// them.
#pragma once

#include <span>

#include "tools/ground_cover/cover.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"
#include "tools/roads/road_class.h"

namespace nightcity::ground_cover {

/// Ranks of the areas of streets; the rank of a road's class is added to those of carriageways and
/// of their ends.
constexpr int carriageway_rank = 1050, carriageway_end_rank = 1000, bay_rank = 950,
              track_rank = 900, path_rank = 820, pavement_rank = 800, square_rank = 790,
              platform_rank = 760;

/// Width of a one-way cycle track beside a carriageway (ERA 2010, 2.2.1), m.
constexpr double cycle_track_m = 2.0;

/// Adds the streets to `cover`, as far as they lie in `bounds` (E, N, m). Where they overlap,
/// carriageways are seen before bays, then cycle tracks, paths and pavements; of carriageways that
/// of the more important road, then of the wider and the longer one, in whatever order the map has
/// them. Widths are those of roads::read_carriageway; `sidewalk` and `cycleway` and their sides say
/// what runs beside it, else the class of the road. With `bays`, `parking` and its sides say where
/// cars park: in bays beside the carriageway, level with it, or on a pavement, which is as wide as
/// they need then. Streets in tunnels and buildings, values that are assumed, and lengths of
/// parking lanes are counted in `cover`.
void add_streets(std::span<const osm::OsmWay> ways, bool bays, const place::LonLatToFrame& to_frame,
                 const Box& bounds, Cover& cover);

/// Returns whether a way with these tags runs in a tunnel or a building, or else below the ground.
bool lies_inside(const osm::OsmTags& tags);

/// Returns what a road is made of: what `surface` says, else what is usual for its class.
GroundKind find_street_surface(const osm::OsmTags& tags, const roads::RoadClass& road);

/// Returns the width of what lies beside a road on one side ("left", "right" of its direction) up to
/// the outer edge of the pavement, m, without bays; 0 where there is no pavement.
double find_roadside_m(const osm::OsmTags& tags, const roads::RoadClass& road, const char* side);

/// Returns how far the areas of a street or path reach from its middle, m: to the kerb, or to the
/// outer edge of the wider pavement. Bays are not counted. 0 where there is no street.
double find_street_reach_m(const osm::OsmTags& tags);

/// The part of a map that decides what is painted on streets.
struct StreetPaint {
  std::span<const osm::OsmWay> ways;
  std::span<const osm::OsmPoint> controls;   // before which vehicles stop
  std::span<const osm::OsmPoint> crossings;  // of people on foot
  bool on_the_left = false;                  // the side of the road that vehicles keep to
  bool bays = true;                          // lines between parking bays
};

/// Adds the bars of crossings, the lines between lanes, those between parking bays, and those at
/// which vehicles stop.
void add_markings(const StreetPaint& paint, const place::LonLatToFrame& to_frame, const Box& bounds,
                  Cover& cover);

}  // namespace nightcity::ground_cover
