// The places where the streets of a map meet.
#pragma once

#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tools/osm/osm_data.h"
#include "tools/roads/carriageway.h"

namespace nightcity::ground_cover {

bool is_drivable(const std::optional<roads::Carriageway>& road);

/// Places where drivable ways meet, by their coordinates as written.
class Junctions {
 public:
  explicit Junctions(std::span<const osm::OsmWay> ways);
  bool holds(const glm::dvec2& lon_lat) const;
  /// Returns the greatest reach into a junction of the ways there other than `way`; 0 where there
  /// is no junction. A way reaches half its width to each side, and `clear_m` more where it is more
  /// than the entrance of a plot.
  double find_reach_m(const glm::dvec2& lon_lat, const osm::OsmWay& way, double clear_m) const;

 private:
  struct Arm {
    const osm::OsmWay* way;
    double half_m;
    bool is_entrance;
    int count;  // a way that goes on has two arms
  };
  std::map<std::pair<double, double>, std::vector<Arm>> arms_;
};

}  // namespace nightcity::ground_cover
