#include "tools/osm/osm_collector.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "tools/osm/osm_selection.h"

namespace nightcity {
namespace {

constexpr double resolution = 1e-7;

template <class Element>
std::size_t drop_repeated(std::vector<Element>& elements, std::unordered_set<std::int64_t>& seen) {
  const auto kept = std::remove_if(elements.begin(), elements.end(), [&](const Element& element) {
    return !seen.insert(element.id).second;
  });
  const auto dropped = static_cast<std::size_t>(elements.end() - kept);
  elements.erase(kept, elements.end());
  return dropped;
}

template <class Element>
std::size_t append_new(std::vector<Element>& to, std::vector<Element>&& from) {
  std::unordered_set<std::int64_t> seen;
  for (const Element& element : to) seen.insert(element.id);
  const std::size_t dropped = drop_repeated(from, seen);
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  return dropped;
}

}  // namespace

void OsmCollector::node(std::int64_t id, const glm::dvec2& lon_lat, OsmTags tags) {
  // Written so that NaN is refused too.
  if (!(std::abs(lon_lat.x) <= 180 && std::abs(lon_lat.y) <= 90)) return bad_node();
  ++nodes_;
  places_.push_back({id, static_cast<std::int32_t>(std::lround(lon_lat.x / resolution)),
                     static_cast<std::int32_t>(std::lround(lon_lat.y / resolution))});
  if (is_lamp(tags)) data_.lamps.push_back({id, lon_lat, std::move(tags)});
}

void OsmCollector::way(std::int64_t id, std::vector<std::int64_t> nodes, OsmTags tags) {
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
  std::unordered_set<std::int64_t> lamps, highways, buildings;
  data_.duplicates += drop_repeated(data_.lamps, lamps) + drop_repeated(data_.highways, highways) +
                      drop_repeated(data_.buildings, buildings);
  return std::move(data_);
}

void OsmData::merge(OsmData&& other) {
  duplicates += other.duplicates;
  duplicates += append_new(lamps, std::move(other.lamps));
  duplicates += append_new(highways, std::move(other.highways));
  duplicates += append_new(buildings, std::move(other.buildings));
  nodes += other.nodes;
  ways += other.ways;
  relations += other.relations;
  missing_nodes += other.missing_nodes;
  bad_coordinates += other.bad_coordinates;
}

}  // namespace nightcity
