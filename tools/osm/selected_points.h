// The nodes of a map that are selected although they have no outline, each in its newest version.
// Included by the one file that assembles areas.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tools/osm/map_areas.h"

namespace nightcity::osm {

class SelectedPoints {
 public:
  /// Keeps a reference to `selection`.
  explicit SelectedPoints(const AreaSelection& selection) : selection_(selection) {}

  /// Adds a node, whose tags are empty where it is deleted or not selected. `rank`: of its version,
  /// greater for newer ones; of equal ones the first counts.
  void add(std::int64_t id, std::uint32_t rank, const glm::dvec2& lon_lat, OsmTags tags) {
    if (tags.empty() && points_.empty()) return;
    const auto known = points_.find(id);
    if (known == points_.end() ? tags.empty() : rank <= known->second.rank) return;
    State& state = points_[id];
    state = {rank, !tags.empty(), lon_lat, {}};
    if (selection_.keeps_points) state.tags = std::move(tags);
  }

  bool is_empty() const { return points_.empty(); }
  bool knows(std::int64_t id) const { return points_.contains(id); }
  std::size_t count() const {
    std::size_t count = 0;
    for (const auto& [id, state] : points_) count += state.is_selected;
    return count;
  }

  /// Returns the points that are kept, by id. A place that is none on the globe has no point.
  std::vector<MapPoint> take() && {
    std::vector<MapPoint> kept;
    for (auto& [id, state] : points_)
      if (!state.tags.empty() && std::abs(state.lon_lat.x) <= 180 &&
          std::abs(state.lon_lat.y) <= 90)
        kept.push_back({"node/" + std::to_string(id), std::move(state.tags), state.lon_lat});
    std::sort(kept.begin(), kept.end(),
              [](const MapPoint& a, const MapPoint& b) { return a.id < b.id; });
    return kept;
  }

 private:
  struct State {
    std::uint32_t rank = 0;
    bool is_selected = false;
    glm::dvec2 lon_lat{0};
    OsmTags tags;
  };

  const AreaSelection& selection_;
  std::unordered_map<std::int64_t, State> points_;
};

}  // namespace nightcity::osm
