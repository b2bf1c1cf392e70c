#include "tools/ground_cover/kerb_ramps.h"

#include <map>
#include <string>
#include <utility>

#include "formats/finite.h"
#include "tools/ground_cover/cover.h"
#include "tools/ground_cover/crossings.h"
#include "tools/ground_cover/junctions.h"
#include "tools/ground_cover/measured_line.h"
#include "tools/ground_cover/painter.h"
#include "tools/ground_cover/way_line.h"
#include "tools/osm/tag_values.h"
#include "tools/roads/carriageway.h"
#include "tools/roads/road_class.h"

namespace nightcity::ground_cover {
namespace {

// Ramps begin this far inside the carriageway, which is not lowered: at a bend its edge is no
// straight line.
constexpr double inside_m = 0.5;

// Returns by how much the kerb of a crossing is lowered; 0: not at all.
double find_drop_m(const osm::OsmTags& tags) {
  const std::string kerb = osm::find_tag(tags, "kerb");
  if (kerb == "raised" || kerb == "yes" || kerb == "regular") return 0;
  if (kerb == "flush" || kerb == "no") return roads::kerb_m;
  return roads::kerb_m - lowered_kerb_m;
}

// Returns whether a street does not lie on the ground that a ramp would lower.
bool is_off_ground(const osm::OsmTags& tags) {
  const auto says = [&](const char* key) {
    const std::string value = osm::find_tag(tags, key);
    return !value.empty() && value != "no" && value != "building_passage";
  };
  return says("tunnel") || says("bridge");
}

class CrossingPlaces {
 public:
  CrossingPlaces(std::span<const osm::OsmPoint> nodes, std::span<const osm::OsmWay> ways) {
    for (const osm::OsmPoint& node : nodes) add(node.lon_lat, node.tags);
    for (const osm::OsmWay& way : ways)
      if (is_crossing_way(way.tags))
        for (const glm::dvec2& p : way.lon_lat) add(p, way.tags);
  }
  bool empty() const { return drops_.empty(); }
  // Returns by how much the kerb is lowered at a node, each once; 0 where it is not.
  double take(const glm::dvec2& lon_lat) {
    const auto found = drops_.find({lon_lat.x, lon_lat.y});
    return found == drops_.end() ? 0 : std::exchange(found->second, 0);
  }

 private:
  // The first to name a place decides.
  void add(const glm::dvec2& lon_lat, const osm::OsmTags& tags) {
    if (finite(lon_lat)) drops_.try_emplace({lon_lat.x, lon_lat.y}, find_drop_m(tags));
  }
  std::map<std::pair<double, double>, double> drops_;
};

}  // namespace

std::vector<RampFacet> make_ramp(const glm::dvec2& kerb, const glm::dvec2& along,
                                 const glm::dvec2& outward, double drop_m) {
  const double half_m = crossing_m / 2, depth_m = drop_m / max_ramp_slope,
               beside_m = half_m + flare_m;
  std::vector<RampFacet> facets;
  // `corners`, `origin` and `gradient` in metres along the kerb and away from it.
  const auto add = [&](std::initializer_list<glm::dvec2> corners, const glm::dvec2& origin,
                       const glm::dvec2& gradient) {
    const auto to_plan = [&](const glm::dvec2& p) { return p.x * along + p.y * outward; };
    RampFacet facet{{}, kerb + to_plan(origin), to_plan(gradient), drop_m};
    for (const glm::dvec2& corner : corners) facet.ring.push_back(kerb + to_plan(corner));
    facets.push_back(std::move(facet));
  };
  add({{-half_m, -inside_m}, {half_m, -inside_m}, {half_m, 0}, {-half_m, 0}}, {0, 0}, {0, 0});
  add({{-half_m, 0}, {half_m, 0}, {half_m, depth_m}, {-half_m, depth_m}}, {0, 0},
      {0, -drop_m / depth_m});
  for (const double side : {-1.0, 1.0}) {
    const double from = side * half_m, to = side * beside_m, fall = -side * drop_m / flare_m;
    add({{from, -inside_m}, {to, -inside_m}, {to, 0}, {from, 0}}, {from, 0}, {fall, 0});
    add({{from, 0}, {to, 0}, {from, depth_m}}, {from, 0}, {fall, -drop_m / depth_m});
  }
  return facets;
}

void add_kerb_ramps(std::span<const osm::OsmWay> ways, std::span<const osm::OsmPoint> crossings,
                    const place::LonLatToFrame& to_frame, const Box& bounds, Cover& cover) {
  CrossingPlaces places(crossings, ways);
  if (places.empty()) return;
  const Junctions junctions(ways);
  for (const osm::OsmWay& way : ways) {
    const auto road = roads::read_carriageway(way.tags);
    if (!is_drivable(road) || !road->road_class->kerbed || is_off_ground(way.tags)) continue;
    const std::vector<glm::dvec2> line = find_line(way.lon_lat, to_frame, bounds);
    if (line.size() < 2 || line.size() != way.lon_lat.size()) continue;
    const MeasuredLine measured(line);
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (!bounds.holds(line[i]) || junctions.holds(way.lon_lat[i])) continue;
      const double drop_m = places.take(way.lon_lat[i]);
      const glm::dvec2 outward = measured.find_beside(measured.at(i), 1) - line[i];
      if (!(drop_m > 0) || !(glm::length(outward) > 0.5)) continue;
      const glm::dvec2 left = glm::normalize(outward), along(left.y, -left.x);
      for (const glm::dvec2& side : {left, -left})
        for (RampFacet& facet :
             make_ramp(line[i] + side * (road->width_m / 2), along, side, drop_m))
          cover.add_ramp(std::move(facet));
      ++cover.lowered_kerbs;
    }
  }
}

}  // namespace nightcity::ground_cover
