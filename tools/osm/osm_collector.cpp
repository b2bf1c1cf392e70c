#include "tools/osm/osm_collector.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/osm/osm_selection.h"

namespace nightcity {
namespace {

constexpr double resolution = 1e-7;

}  // namespace

void OsmCollector::add_node(std::int64_t id, const glm::dvec2& lon_lat, OsmTags tags) {
  // These comparisons are false for NaN too.
  if (!(std::abs(lon_lat.x) <= 180 && std::abs(lon_lat.y) <= 90)) return count_bad_node();
  ++nodes_;
  places_.push_back({id, static_cast<std::int32_t>(std::lround(lon_lat.x / resolution)),
                     static_cast<std::int32_t>(std::lround(lon_lat.y / resolution))});
  if (is_lamp(tags)) data_.lamps.push_back({id, lon_lat, std::move(tags)});
}

void OsmCollector::add_way(std::int64_t id, std::vector<std::int64_t> nodes, OsmTags tags) {
  ++data_.ways;
  const bool highway = is_highway(tags);
  if (!highway && !is_building(tags)) return;
  pending_.push_back({{id, {}, std::move(tags)}, std::move(nodes), highway});
}

OsmData OsmCollector::finish() && {
  data_.nodes = nodes_;
  std::stable_sort(places_.begin(), places_.end(),
                   [](const Place& a, const Place& b) { return a.id < b.id; });
  for (PendingWay& pending : pending_) {
    for (const std::int64_t id : pending.nodes) {
      const auto place =
          std::lower_bound(places_.begin(), places_.end(), id,
                           [](const Place& p, std::int64_t wanted) { return p.id < wanted; });
      if (place == places_.end() || place->id != id)
        ++data_.missing_nodes;
      else
        pending.way.lon_lat.emplace_back(place->lon * resolution, place->lat * resolution);
    }
    if (pending.way.lon_lat.size() < 2) continue;
    (pending.highway ? data_.highways : data_.buildings).push_back(std::move(pending.way));
  }
  OsmData unique;
  unique.merge(std::move(data_));
  return unique;
}

}  // namespace nightcity
