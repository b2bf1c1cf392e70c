// The bars of crossings for people on foot, from their ways or, where there is none, from their
// nodes.
#pragma once

#include <glm/vec2.hpp>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "tools/ground_cover/junctions.h"
#include "tools/ground_cover/painter.h"
#include "tools/osm/osm_data.h"
#include "tools/roads/carriageway.h"

namespace nightcity::ground_cover {

/// Returns whether a way is the crossing of a path over a street.
bool is_crossing_way(const osm::OsmTags& tags);

/// Returns whether a way is a crossing that says itself that it has bars.
bool is_marked_crossing(const osm::OsmTags& tags);

/// Adds the bars along the way of a crossing. `line`: its points in the frame.
void add_bars(const std::vector<glm::dvec2>& line, Painter& painter);

class CrossingNodes {
 public:
  /// Keeps the nodes that say that they have bars, but for those on the way of a crossing that says
  /// what is painted there.
  CrossingNodes(std::span<const osm::OsmPoint> nodes, std::span<const osm::OsmWay> ways,
                const Junctions& junctions, Painter& painter);

  /// Adds bars across a drivable way at its nodes, each once. `line`: its points in the frame.
  void add(const osm::OsmWay& way, const roads::Carriageway& road,
           const std::vector<glm::dvec2>& line);

 private:
  std::set<std::pair<double, double>> places_;  // that are to be painted yet
  const Junctions& junctions_;
  Painter& painter_;
};

}  // namespace nightcity::ground_cover
