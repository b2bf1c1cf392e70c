// Covers the ground of a city: areas of streets and land, in order of priority.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tools/ground_cover/box_index.h"
#include "tools/ground_cover/ground_kind.h"
#include "tools/mesh/partition.h"

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
};

/// The areas of a part of the city, as layers of mesh::partition. Labels are numbers of surfaces.
struct CoverPart {
  mesh::PlaneLayer areas, markings;
};

class Cover {
 public:
  /// Areas that overlap are seen in order of rank; those of equal rank in the order of adding. Call
  /// finish() when all are added.
  void add(CoverArea area) { areas_.push_back(std::move(area)); }
  /// Adds paint, which is seen on carriageways alone.
  void add_marking(std::vector<glm::dvec2> ring) { markings_.push_back(std::move(ring)); }
  void finish();

  bool empty() const { return areas_.empty(); }
  const std::vector<Surface>& surfaces() const { return surfaces_; }
  const std::vector<CoverArea>& areas() const { return areas_; }

  /// Returns what lies within a rectangle of the plan, cut to it, with coordinates relative to
  /// `origin`. Safe on many threads after finish().
  CoverPart find_part(const Box& box, const glm::dvec2& origin) const;
  /// Returns by how much the surface at a place lies below the ground, m.
  double depth_at(const glm::dvec2& place) const;

  /// Returns what covers a place; null where it is bare.
  const Surface* surface_at(const glm::dvec2& place) const;

  /// Things that were not used, and how often.
  std::map<std::string, std::size_t> left_out;
  /// Markings, by what they are, and how many.
  std::map<std::string, std::size_t> markings;
  /// Values that no tag gives, and how often they were assumed.
  std::map<std::string, std::size_t> assumed;

 private:
  const CoverArea* find_first(const BoxIndex& index, const glm::dvec2& place) const;

  std::vector<CoverArea> areas_;
  std::vector<std::vector<glm::dvec2>> markings_;
  std::vector<Surface> surfaces_;
  std::vector<std::uint32_t> labels_;  // of each area: its surface
  std::vector<Box> boxes_;             // of each area
  BoxIndex area_index_, marking_index_;
  BoxIndex depth_index_;  // of the areas down to the last that is sunken: no other decides depths
};

}  // namespace nightcity::ground_cover
