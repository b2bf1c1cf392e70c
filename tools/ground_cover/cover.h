// Covers the ground of a city: areas of streets and land, in order of priority.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tools/ground_cover/box_index.h"
#include "tools/ground_cover/ground_kind.h"
#include "tools/ground_cover/kerb_ramps.h"
#include "tools/mesh/partition.h"
#include "tools/osm/osm_data.h"

namespace nightcity::ground_cover {

/// The cover of a place.
struct Surface {
  GroundKind kind = GroundKind::asphalt;
  bool sunken = false;  // lies below the ground around it, by the height of a kerb
  bool marked = false;  // a place where markings may lie: a carriageway
  auto operator<=>(const Surface&) const = default;
};

struct CoverArea {
  /// The order of priority: where areas overlap, the greater rank is seen.
  int rank = 0;
  Surface surface;
  std::vector<std::vector<glm::dvec2>> rings;  // E, N of the city's frame, m
  std::shared_ptr<const osm::OsmTags> tags{};  // of woods alone: what their trees are like
};

/// Markings lie flush in the ground on top of its cover; they are in order of priority.
enum class Marking : std::uint8_t {
  rail,  // seen everywhere
  paint  // seen on carriageways alone
};

/// The areas of a part of the city, as layers of mesh::partition. Labels are numbers of surfaces,
/// those of markings are of Marking, and those of ramps numbers of facets.
struct CoverPart {
  mesh::PlaneLayer areas, markings, ramps;
};

class Cover {
 public:
  /// Areas that overlap are seen in order of rank; those of equal rank in the order of adding. Call
  /// finish() when all are added.
  void add(CoverArea area) { areas_.push_back(std::move(area)); }
  void add_marking(std::vector<glm::dvec2> ring, Marking kind = Marking::paint) {
    markings_.push_back({std::move(ring), kind});
  }
  /// Adds a facet of a ramp. Of several in one place the first counts; none lowers a surface that
  /// is sunken.
  void add_ramp(RampFacet facet) { ramps_.push_back(std::move(facet)); }
  void finish();

  bool empty() const { return areas_.empty() && markings_.empty(); }
  const std::vector<Surface>& surfaces() const { return surfaces_; }
  const std::vector<CoverArea>& areas() const { return areas_; }
  const std::vector<RampFacet>& ramps() const { return ramps_; }

  /// Returns what lies within a rectangle of the plan, cut to it, with coordinates relative to
  /// `origin`. Safe on many threads after finish().
  CoverPart find_part(const Box& box, const glm::dvec2& origin) const;
  /// Returns by how much the surface at a place lies below the ground, m.
  double depth_at(const glm::dvec2& place) const;

  /// Returns what covers a place; null where it is bare.
  const Surface* surface_at(const glm::dvec2& place) const;

  /// Things that were not used, and how often.
  std::map<std::string, std::size_t> left_out;
  /// Crossings with ramps.
  std::size_t lowered_kerbs = 0;
  /// Corners of junctions that are round.
  std::size_t rounded_corners = 0;
  /// Markings, by what they are, and how many.
  std::map<std::string, std::size_t> markings;
  /// Values that no tag gives, and how often they were assumed.
  std::map<std::string, std::size_t> assumed;
  /// Lengths within the ground, m: of tracks, by what they are and lie in; of parking lanes, by
  /// place and orientation; of what was not used, by reason.
  std::map<std::string, double> tracks_m, parking_m, left_out_m;

 private:
  double find_lowering_m(const glm::dvec2& place) const;
  const CoverArea* find_first(const BoxIndex& index, const glm::dvec2& place) const;

  std::vector<CoverArea> areas_;
  struct MarkingRing {
    std::vector<glm::dvec2> ring;
    Marking kind;
  };
  std::vector<MarkingRing> markings_;
  std::vector<RampFacet> ramps_;
  std::vector<Surface> surfaces_;
  std::vector<std::uint32_t> labels_;  // of each area: its surface
  std::vector<Box> boxes_;             // of each area
  BoxIndex area_index_, marking_index_, ramp_index_;
  BoxIndex depth_index_;  // of the areas down to the last that is sunken: no other decides depths
};

}  // namespace nightcity::ground_cover
