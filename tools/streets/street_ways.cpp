#include "tools/streets/street_ways.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <unordered_map>

#include "tools/in_ring.h"
#include "tools/roads/carriageway.h"
#include "tools/streets/centrelines.h"

namespace nightcity::streets {
namespace {

constexpr double chord_step_m = 2.5;
// A surface that is not marked as a carriageway has pavements on both sides if it is wide enough
// for them. The least width that road codes ask for is 2 m each (RASt 06; Japan's Road Structure
// Ordinance, article 11).
constexpr double pavement_m = 2.0, with_pavements_m = 9.0;

/// Finds the surface under a place by a grid over the surfaces' bounding boxes.
class SurfaceIndex {
 public:
  explicit SurfaceIndex(const std::vector<RoadSurface>& surfaces) : surfaces_(surfaces) {
    for (std::uint32_t n = 0; n < surfaces.size(); ++n) {
      glm::dvec2 low = surfaces[n].exterior.front(), high = low;
      for (const glm::dvec2& p : surfaces[n].exterior)
        low = glm::min(low, p), high = glm::max(high, p);
      if (glm::distance(low, high) > largest_m) continue;  // a district as one road
      for (std::int64_t x = cell(low.x); x <= cell(high.x); ++x)
        for (std::int64_t y = cell(low.y); y <= cell(high.y); ++y) cells_[key(x, y)].push_back(n);
    }
  }

  const RoadSurface* at(const glm::dvec2& p) const {
    const auto found = cells_.find(key(cell(p.x), cell(p.y)));
    if (found == cells_.end()) return nullptr;
    for (const std::uint32_t n : found->second)
      if (in_ring(surfaces_[n].exterior, p)) return &surfaces_[n];
    return nullptr;
  }

 private:
  static constexpr double cell_m = 25, largest_m = 5000;

  static std::int64_t cell(double x) { return static_cast<std::int64_t>(std::floor(x / cell_m)); }
  static std::uint64_t key(std::int64_t x, std::int64_t y) {
    return static_cast<std::uint64_t>(x) << 32 ^ (static_cast<std::uint64_t>(y) & 0xFFFFFFFFu);
  }

  const std::vector<RoadSurface>& surfaces_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

/// The class of a line by the surfaces below it; each surface counts with the length of line over
/// it.
struct SurfaceVote {
  std::string highway;  // "": unknown
  bool carriageway = false;
};
SurfaceVote vote_on(const SurfaceIndex& index, const std::vector<glm::dvec2>& line) {
  constexpr double step_m = 3;
  std::map<std::string, double> votes;
  double carriageway = 0, all = 0;
  for (std::size_t n = 1; n < line.size(); ++n) {
    const double length = glm::distance(line[n - 1], line[n]);
    const int steps = std::max(1, static_cast<int>(std::ceil(length / step_m)));
    for (int k = 0; k < steps; ++k) {
      const RoadSurface* surface =
          index.at(line[n - 1] + (line[n] - line[n - 1]) * ((k + 0.5) / steps));
      if (!surface) continue;
      const double weight = length / steps;
      votes[surface->highway ? surface->highway : ""] += weight;
      carriageway += surface->carriageway ? weight : 0;
      all += weight;
    }
  }
  SurfaceVote vote;
  vote.carriageway = carriageway > all / 2;
  for (const auto& [highway, weight] : votes)
    if (weight > all / 2) vote.highway = highway;
  return vote;
}

}  // namespace

StreetWays find_street_ways(const RoadSurfaces& roads,
                            const std::function<glm::dvec2(const glm::dvec2&)>& to_lon_lat,
                            int max_crossings, int max_points) {
  StreetWays result;
  if (roads.surfaces().empty()) return result;
  const auto lines = find_centrelines(
      chordal_axis(road_outline(roads.surfaces(), max_crossings), chord_step_m, max_points));
  const SurfaceIndex index(roads.surfaces());
  std::map<std::size_t, int> ends;
  for (const Centreline& street : lines) {
    if (street.width_m < roads::min_lane_m) continue;
    const SurfaceVote vote = vote_on(index, street.line);
    double width = street.width_m;
    if (!vote.carriageway && width >= with_pavements_m) width -= 2 * pavement_m;
    const std::string highway = vote.highway.empty() ? roads::guess_highway(width) : vote.highway;
    osm::OsmWay way;
    way.id = -1 - static_cast<std::int64_t>(result.ways.size());  // OSM's own are greater than 0
    way.tags = {{"highway", highway}, {"width", fmt::format("{:.1f}", width)}};
    if (width >= 12) way.tags.emplace("lanes", "4");
    for (const glm::dvec2& p : street.line) way.lon_lat.push_back(to_lon_lat(p));
    const bool finite =
        std::all_of(way.lon_lat.begin(), way.lon_lat.end(),
                    [](const glm::dvec2& p) { return std::isfinite(p.x) && std::isfinite(p.y); });
    if (!finite) continue;
    double km = 0;
    for (std::size_t n = 1; n < street.line.size(); ++n)
      km += glm::distance(street.line[n - 1], street.line[n]) / 1000;
    result.km[highway] += km;
    if (!vote.highway.empty()) result.km_by_code += km;
    ++ends[street.from];
    ++ends[street.to];
    result.ways.push_back(std::move(way));
  }
  for (const auto& [node, count] : ends) {
    result.junctions += count > 2;
    result.ends += count == 1;
  }
  return result;
}

}  // namespace nightcity::streets
