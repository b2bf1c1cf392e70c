#include "tools/osm/osm_collector.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "tools/osm/crowded_streets.h"
#include "tools/osm/kind_keys.h"
#include "tools/osm/lifecycle.h"
#include "tools/osm/mean_place.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/repeated_things.h"
#include "tools/osm/resolution.h"
#include "tools/osm/tag_values.h"
#include "tools/place/longitude.h"

namespace nightcity::osm {
namespace {

constexpr std::int32_t deleted_lon = std::numeric_limits<std::int32_t>::min();

// These comparisons are false for NaN too.
bool on_globe(const glm::dvec2& lon_lat) {
  return std::abs(lon_lat.x) <= 180 && std::abs(lon_lat.y) <= 90;
}

// Returns whether a relation is an area of which its outer ways say what it is (OuterWays).
bool is_untagged_area(const OsmTags& tags) {
  return find_tag(tags, "type") == "multipolygon" &&
         std::none_of(kind_keys.begin(), kind_keys.end(),
                      [&](std::string_view key) { return tags.contains(std::string(key)); });
}

// A node that a way names twice in a row would be a junction to what counts arms.
void add_corner(OsmWay& way, const glm::dvec2& lon_lat) {
  if (way.lon_lat.empty() || way.lon_lat.back() != lon_lat) way.lon_lat.push_back(lon_lat);
}

}  // namespace

OsmCollector::Key OsmCollector::key_of(std::int64_t id) const {
  const auto bits = static_cast<std::uint64_t>(id);
  return {static_cast<std::uint32_t>(bits >> 32), static_cast<std::uint32_t>(bits),
          id < 0 ? file_ : 0};
}

void OsmCollector::add_node(std::int64_t id, OsmVersion version, const glm::dvec2& lon_lat,
                            OsmTags tags) {
  if (reads_members_) return relations_.add_node(id, file_, version, std::move(tags));
  const Key key = key_of(id);
  if (version.deleted) return places_.push_back({key, version.rank(), deleted_lon, 0});
  if (!on_globe(lon_lat)) return count_bad_node();
  ++nodes_;
  places_.push_back({key, version.rank(), static_cast<std::int32_t>(to_steps(lon_lat.x)),
                     static_cast<std::int32_t>(to_steps(lon_lat.y))});
  if (is_gone(tags, today_) && !is_lamp(tags)) {
    data_.gone += may_shine(tags) || is_control(tags) || is_crossing(tags) || is_square(tags) ||
                  is_tree(tags) || is_gate(tags);
    return;
  }
  if (may_shine(tags)) things_.push_back({{id, false, {lon_lat}, tags}, key, version.rank()});
  if (is_control(tags)) controls_.push_back({{lon_lat, tags}, key, version.rank()});
  if (is_crossing(tags)) crossings_.push_back({{lon_lat, tags}, key, version.rank()});
  if (is_square(tags)) squares_.push_back({{lon_lat, tags}, key, version.rank()});
  if (is_lamp(tags))
    lamps_.push_back({{id, lon_lat, std::move(tags)}, key, version.rank()});
  else if (is_tree(tags))
    trees_.push_back({{lon_lat, std::move(tags)}, key, version.rank()});
  else if (is_gate(tags))
    gates_.push_back({{lon_lat, std::move(tags)}, key, version.rank()});
}

void OsmCollector::add_way(std::int64_t id, OsmVersion version, std::vector<OsmNodeRef> nodes,
                           OsmTags tags) {
  if (reads_members_)
    return relations_.add_way(id, file_, version, std::move(nodes), std::move(tags));
  const Key key = key_of(id);
  way_states_.push_back({key, version.rank(), version.deleted});
  if (version.deleted) return;
  ++data_.ways;
  data_.roof_lines += tags.contains("roof:ridge") || tags.contains("roof:edge");
  if (!is_highway(tags) && !is_building(tags) && !is_lamp(tags) && !is_tree_row(tags) &&
      !is_barrier(tags) && !is_railway(tags) && !is_watercourse(tags) && !may_shine(tags))
    return;
  if (is_gone(tags, today_) && !is_lamp(tags)) {
    ++data_.gone;
    return;
  }
  if (nodes.size() > max_way_nodes_) {
    ++data_.long_ways;
    return;
  }
  pending_.push_back({{id, {}, std::move(tags)}, std::move(nodes), key, version.rank(), file_});
}

void OsmCollector::add_bounds(LonLatBox box) {
  if (reads_members_ || !on_globe(box.low) || !on_globe(box.high) || box.low.y > box.high.y) return;
  // Across the antimeridian west is greater than east (RFC 7946, section 5.2).
  if (box.low.x > box.high.x) box.high.x = place::count_on(box.high.x, box.low.x);
  if (box.low.x > box.high.x) return;
  if (bounded_files_ == 0 || bounded_file_ != file_) ++bounded_files_;
  bounded_file_ = file_;
  if (!data_.bounds) data_.bounds = box;
  LonLatBox& all = *data_.bounds;
  const double middle = (box.low.x + box.high.x) / 2,
               turn = place::count_on(middle, (all.low.x + all.high.x) / 2) - middle;
  if (turn != 0) box.low.x += turn, box.high.x += turn;
  all = {glm::min(all.low, box.low), glm::max(all.high, box.high)};
}

void OsmCollector::add_relation(std::int64_t id, OsmVersion version, OsmRelation relation) {
  if (reads_members_) return;
  const OsmTags& tags = relation.tags;
  data_.relations += !version.deleted;
  if (is_barrier(tags)) ++data_.barrier_relations;
  if (is_building(tags) || is_untagged_area(tags)) ++data_.building_relations;
  relations_.add({id, id < 0 ? file_ : 0}, version, std::move(relation));
}

bool OsmCollector::begin_members() {
  reads_members_ = relations_.choose();
  if (reads_members_) file_ = 0;
  return reads_members_;
}

/// Behind all places, and before lamps and ways are placed.
void OsmCollector::add_lamps_of_relations() {
  const auto find_place = [&](const LampRelations::Key& node) -> std::optional<glm::dvec2> {
    file_ = node.second;
    const Place* place = find(places_, key_of(node.first));
    if (!place || place->lon == deleted_lon) return std::nullopt;
    return glm::dvec2(place->lon * resolution_degrees, place->lat * resolution_degrees);
  };
  std::map<Key, OsmTags*> of_nodes, of_ways;
  for (PendingLamp& lamp : lamps_) of_nodes[lamp.key] = &lamp.lamp.tags;
  for (PendingWay& way : pending_)
    if (is_lamp(way.way.tags)) of_ways[way.key] = &way.way.tags;
  const auto complete = [&](const OsmMember& member, const LampRelations::Key& id,
                            const OsmTags& tags) {
    file_ = id.second;
    const auto& known = member.type == OsmMember::Type::node ? of_nodes : of_ways;
    if (const auto found = known.find(key_of(id.first)); found != known.end())
      found->second->insert(tags.begin(), tags.end());
  };
  for (OsmLampNode& lamp : relations_.place(find_place, complete, data_.lamp_relations))
    data_.lamps.push_back(std::move(lamp));
}

/// Sorts by key and keeps the newest of each, of equally new ones the first.
template <class Entry>
void OsmCollector::keep_newest(std::vector<Entry>& entries) {
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.key, b.rank) < std::tie(b.key, a.rank);
  });
  entries.erase(std::unique(entries.begin(), entries.end(),
                            [](const Entry& a, const Entry& b) { return a.key == b.key; }),
                entries.end());
}

template <class Entry>
const Entry* OsmCollector::find(const std::vector<Entry>& entries, const Key& key) {
  const auto found =
      std::lower_bound(entries.begin(), entries.end(), key,
                       [](const Entry& entry, const Key& wanted) { return entry.key < wanted; });
  return found == entries.end() || found->key != key ? nullptr : &*found;
}

/// Removes elements of which there is a newer version or an equal one before, and counts them. The
/// rest is sorted by id, so that no stage depends on the order in which a map was written; those of
/// editors, whose negative ids say nothing, come behind in the order of the file.
template <class Pending, class Entry>
void OsmCollector::drop_old(std::vector<Pending>& pending, const std::vector<Entry>& newest) {
  std::vector<const Pending*> order;
  for (const Pending& element : pending) order.push_back(&element);
  std::stable_sort(order.begin(), order.end(),
                   [](const Pending* a, const Pending* b) { return a->key < b->key; });
  std::vector<bool> drop(pending.size());
  const Pending* kept = nullptr;
  for (const Pending* element : order) {
    const auto n = static_cast<std::size_t>(element - pending.data());
    if (const Entry* entry = find(newest, element->key); entry && entry->rank > element->rank) {
      drop[n] = true;
      ++data_.old_versions;
    } else if (kept && kept->key == element->key) {
      drop[n] = true;
      ++data_.duplicates;
    } else {
      kept = element;
    }
  }
  std::size_t n = 0;
  std::erase_if(pending, [&](const Pending&) { return drop[n++]; });
  const auto before = [](const Pending& a, const Pending& b) {
    const auto of_editor = [](const Pending& element) { return element.key.high >> 31 != 0; };
    return of_editor(a) || of_editor(b) ? of_editor(a) < of_editor(b) : a.key < b.key;
  };
  if (!std::is_sorted(pending.begin(), pending.end(), before))
    std::stable_sort(pending.begin(), pending.end(), before);
}

/// Moves the newest version of each point to `points`, in the resolution that ways have.
void OsmCollector::place_points(std::vector<PendingPoint>& pending, std::vector<OsmPoint>& points) {
  drop_old(pending, places_);
  for (PendingPoint& element : pending) {
    OsmPoint& point = element.point;
    const glm::dvec2 rounded(round_degrees(point.lon_lat.x), round_degrees(point.lon_lat.y));
    points.push_back({rounded, std::move(point.tags)});
  }
}

/// Gives the ways their coordinates and sorts them by what they are.
void OsmCollector::place_ways() {
  for (PendingWay& pending : pending_) {
    file_ = pending.file;
    OsmWay& way = pending.way;
    for (const OsmNodeRef& node : pending.nodes) {
      const Place* place = find(places_, key_of(node.id));
      if (place && place->lon != deleted_lon)
        add_corner(way, {place->lon * resolution_degrees, place->lat * resolution_degrees});
      else if (on_globe(node.lon_lat))
        add_corner(way, {round_degrees(node.lon_lat.x), round_degrees(node.lon_lat.y)});
      else
        ++data_.missing_nodes;
    }
    data_.missing_nodes +=
        pending.nodes.empty();  // as `out tags` and `out bb` of Overpass leave it
    const bool highway = is_highway(way.tags);
    if (!highway && is_lamp(way.tags) && !way.lon_lat.empty())
      data_.lamps.push_back({way.id, find_mean_place(way.lon_lat), way.tags, true});
    if (way.lon_lat.size() < 2) continue;
    if (may_shine(way.tags)) data_.shining_things.push_back({way.id, true, way.lon_lat, way.tags});
    if (is_barrier(way.tags)) data_.barriers.push_back(way);
    if (is_railway(way.tags)) data_.railways.push_back(way);
    if (is_watercourse(way.tags)) data_.watercourses.push_back(way);
    if (highway)
      data_.highways.push_back(std::move(way));
    else if (is_building(way.tags))
      data_.buildings.push_back(std::move(way));
    else if (is_tree_row(way.tags))
      data_.tree_rows.push_back(std::move(way));
  }
}

OsmData OsmCollector::finish() && {
  data_.nodes = nodes_;
  if (bounded_files_ != file_) data_.bounds.reset();
  keep_newest(places_);
  keep_newest(way_states_);
  drop_old(lamps_, places_);
  drop_old(things_, places_);
  drop_old(pending_, way_states_);
  if (reads_members_) add_lamps_of_relations();
  for (PendingLamp& pending : lamps_) data_.lamps.push_back(std::move(pending.lamp));
  place_points(trees_, data_.trees);
  place_points(controls_, data_.controls);
  place_points(crossings_, data_.crossings);
  place_points(gates_, data_.gates);
  place_points(squares_, data_.squares);
  for (PendingThing& pending : things_) data_.shining_things.push_back(std::move(pending.thing));
  place_ways();
  data_.repeated = leave_out_repeated(data_);
  data_.crowded_ways = leave_out_crowded(data_.highways) + leave_out_crowded(data_.railways);
  std::stable_sort(data_.shining_things.begin(), data_.shining_things.end(),
                   [](const OsmShiningThing& a, const OsmShiningThing& b) {
                     return std::tie(a.is_way, a.id) < std::tie(b.is_way, b.id);
                   });
  return std::move(data_);
}

}  // namespace nightcity::osm
