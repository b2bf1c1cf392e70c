#include "tools/osm/outer_ways.h"

#include <osmium/osm/item_type.hpp>
#include <osmium/osm/location.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "tools/osm/kind_keys.h"
#include "tools/osm/tag_values.h"

namespace nightcity::osm {
namespace {

// Finds the ring that a way lies on, in a time that does not grow with the number of rings.
class RingFinder {
 public:
  /// Rings are numbered in this order.
  void add(const osmium::NodeRefList& ring) {
    std::unordered_set<osmium::Location> places;
    for (const osmium::NodeRef& node : ring)
      if (places.insert(node.location()).second)
        rings_at_[node.location()].push_back(static_cast<std::uint32_t>(rings_.size()));
    rings_.push_back(std::move(places));
  }

  /// Returns the first ring that has all nodes of the way; none without.
  std::optional<std::size_t> find(const osmium::Way& way) const {
    // Many rings may touch each other in one place, but not in all.
    const std::vector<std::uint32_t>* fewest = nullptr;
    for (const osmium::NodeRef& node : way.nodes()) {
      const auto at = rings_at_.find(node.location());
      if (at == rings_at_.end()) return std::nullopt;
      if (!fewest || at->second.size() < fewest->size()) fewest = &at->second;
    }
    if (!fewest) return std::nullopt;
    for (const std::uint32_t ring : *fewest)
      if (std::all_of(way.nodes().begin(), way.nodes().end(), [&](const osmium::NodeRef& node) {
            return rings_[ring].contains(node.location());
          }))
        return ring;
    return std::nullopt;
  }

 private:
  std::vector<std::unordered_set<osmium::Location>> rings_;
  std::unordered_map<osmium::Location, std::vector<std::uint32_t>> rings_at_;
};

OsmTags to_tags(const osmium::TagList& list) {
  OsmTags tags;
  for (const osmium::Tag& tag : list) tags.emplace(tag.key(), tag.value());
  return tags;
}

// The tags that both have.
OsmTags find_common(const OsmTags& a, const OsmTags& b) {
  OsmTags common;
  for (const auto& [key, value] : a)
    if (const auto found = b.find(key); found != b.end() && found->second == value)
      common.emplace(key, value);
  return common;
}

}  // namespace

bool is_untagged_multipolygon(const osmium::Relation& relation) {
  const char* type = relation.tags().get_value_by_key("type");
  return type && std::strcmp(type, "multipolygon") == 0 &&
         std::none_of(kind_keys.begin(), kind_keys.end(),
                      [&](std::string_view key) { return relation.tags().has_key(key.data()); });
}

void OuterWays::add(const osmium::Relation& relation, const std::vector<const osmium::Way*>& ways,
                    const osmium::Area& area) {
  if (!select_(relation.tags()).empty())
    add_tagged(relation, ways, area);
  else if (is_untagged_multipolygon(relation))
    add_untagged(relation, ways, area);
}

void OuterWays::add_untagged(const osmium::Relation& relation,
                             const std::vector<const osmium::Way*>& ways,
                             const osmium::Area& area) {
  std::vector<OuterRing> rings;
  RingFinder outer_finder, inner_finder;
  std::vector<std::size_t> outer_of;  // of each inner ring
  for (const osmium::OuterRing& outer : area.outer_rings()) {
    outer_finder.add(outer);
    for (const osmium::InnerRing& inner : area.inner_rings(outer)) {
      inner_finder.add(inner);
      outer_of.push_back(rings.size());
    }
    rings.emplace_back();
  }
  std::vector<std::vector<osmium::object_id_type>> said_by(rings.size());
  for (const osmium::Way* way : ways) {
    const auto number = outer_finder.find(*way);
    if (!number) continue;
    OuterRing& ring = rings[*number];
    if (way->is_closed()) ring.own_way = way->id();
    const OsmTags tags = select_(way->tags());
    if (tags.empty()) continue;  // a piece of the outline that somebody has cut
    ring.tags = said_by[*number].empty() ? tags : find_common(ring.tags, tags);
    said_by[*number].push_back(way->id());
  }
  for (std::size_t n = 0; n < rings.size(); ++n) {
    // Ways that say different things make no area together, and stay what they are.
    const bool agree = std::any_of(keys_.begin(), keys_.end(), [&](const std::string& key) {
      return rings[n].tags.contains(key);
    });
    if (agree)
      replaced_.insert(said_by[n].begin(), said_by[n].end());
    else
      rings[n].tags.clear();
  }
  for (const osmium::Way* way : ways) {
    const auto number = inner_finder.find(*way);  // none for a way without nodes, which has no end
    if (!number || !way->is_closed()) continue;
    const OsmTags tags = select_(way->tags());
    if (!tags.empty() && tags == rings[outer_of[*number]].tags) replaced_.insert(way->id());
  }
  OsmTags of_relation = to_tags(relation.tags());
  of_relation.erase("type");
  bool any = false;
  for (OuterRing& ring : rings) {
    if (ring.tags.empty()) continue;
    any = true;
    ring.tags.insert(of_relation.begin(), of_relation.end());
  }
  if (any) rings_[relation.id()] = std::move(rings);
}

void OuterWays::add_tagged(const osmium::Relation& relation,
                           const std::vector<const osmium::Way*>& ways, const osmium::Area& area) {
  const OsmTags tags = select_(relation.tags());
  std::vector<const osmium::Way*> same;
  for (const osmium::Way* way : ways)
    if (!way->tags().empty() && is_same_thing(tags, select_(way->tags()))) same.push_back(way);
  if (same.empty()) return;
  RingFinder finder;
  std::size_t rings = 0;
  for (const osmium::OuterRing& outer : area.outer_rings()) {
    finder.add(outer);
    ++rings;
  }
  for (const osmium::Way* way : same) {
    if (!finder.find(*way)) continue;
    replaced_.insert(way->id());
    if (rings == 1 && way->is_closed()) more_tags_[relation.id()] = to_tags(way->tags());
  }
}

// A value that both have, or "yes" on one side, for what the other says more exactly.
bool OuterWays::is_same_thing(const OsmTags& relation, const OsmTags& way) const {
  return std::any_of(keys_.begin(), keys_.end(), [&](const std::string& key) {
    const auto a = relation.find(key), b = way.find(key);
    if (a == relation.end() || b == way.end()) return false;
    const std::string first = normalise_tag(a->second), second = normalise_tag(b->second);
    return first == second || first == "yes" || second == "yes";
  });
}

const std::vector<OuterRing>* OuterWays::find_rings(osmium::object_id_type relation) const {
  const auto found = rings_.find(relation);
  return found == rings_.end() ? nullptr : &found->second;
}

const OsmTags* OuterWays::find_more_tags(osmium::object_id_type relation) const {
  const auto found = more_tags_.find(relation);
  return found == more_tags_.end() ? nullptr : &found->second;
}

}  // namespace nightcity::osm
