// The lines at which vehicles stop before signs and signals.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "tools/ground_cover/junctions.h"
#include "tools/ground_cover/measured_line.h"
#include "tools/ground_cover/painter.h"
#include "tools/osm/osm_data.h"
#include "tools/roads/carriageway.h"

namespace nightcity::ground_cover {

class StopLines {
 public:
  /// `on_the_left`: the side of the road that vehicles keep to.
  StopLines(std::span<const osm::OsmPoint> controls, const Junctions& junctions, bool on_the_left,
            Painter& painter);

  /// Adds the lines of a drivable way across the lanes that face a sign or a signal: as `direction`
  /// and `traffic_signals:direction` say; else as the way's one direction, else as the junction
  /// that is nearest along it, else, at a signal, on both sides. `line`: the way's points in the
  /// frame.
  void add(const osm::OsmWay& way, const roads::Carriageway& road,
           const std::vector<glm::dvec2>& line) const;

 private:
  using Directions = std::array<bool, 2>;  // along the way, against it
  // `junctions_m`: of the way's junctions, from its start, as `at_m` is of the node.
  Directions find_directions(const roads::Carriageway& road, const std::vector<double>& junctions_m,
                             const glm::dvec2& node, double at_m, const osm::OsmTags& tags) const;
  void paint(const roads::Carriageway& road, const MeasuredLine& along, double at_m, bool against,
             const osm::OsmTags& tags) const;

  std::map<std::pair<double, double>, const osm::OsmPoint*> controls_;
  const Junctions& junctions_;
  bool on_the_left_;
  Painter& painter_;
};

}  // namespace nightcity::ground_cover
