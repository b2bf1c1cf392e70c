// What the map says buildings are used for, where the city model does not.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <unordered_map>
#include <vector>

#include "tools/lights/building_use.h"
#include "tools/osm/osm_data.h"

namespace nightcity {

/// From building=*, and where that says no more than "yes" from shop, office, amenity and tourism on the same
/// outline. Nothing where none of them tells.
std::optional<BuildingUse> use_from_tags(const OsmTags& tags);

/// Outlines of mapped buildings whose use is told, found by place.
class OsmUses {
 public:
  /// `to_frame` as place_lamps takes it. Outlines that are open, broken or wider than 2 km are left out.
  OsmUses(const std::vector<OsmWay>& buildings,
          const std::function<glm::dvec2(const glm::dvec2&)>& to_frame);

  /// Of the smallest outline around the place; nothing where there is none.
  std::optional<BuildingUse> at(const glm::dvec2& place) const;

 private:
  struct Outline {
    std::vector<glm::dvec2> ring;
    double area_m2;
    BuildingUse use;
  };
  std::vector<Outline> outlines_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace nightcity
