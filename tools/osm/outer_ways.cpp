#include "tools/osm/outer_ways.h"

#include <osmium/osm/item_type.hpp>
#include <osmium/osm/location.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <utility>

#include "tools/osm/tag_values.h"

namespace nightcity::osm {
namespace {

// Keys that say what a thing is: a relation with one of them speaks for itself.
constexpr std::array<std::string_view, 32> kinds = {
    "building", "building:part", "landuse",   "landcover",       "natural", "leisure",  "amenity",
    "highway",  "area:highway",  "waterway",  "water",           "wetland", "boundary", "place",
    "man_made", "tourism",       "historic",  "barrier",         "railway", "aeroway",  "shop",
    "office",   "power",         "military",  "indoor",          "sport",   "parking",  "craft",
    "club",     "healthcare",    "emergency", "public_transport"};

using Corners = std::unordered_set<osmium::Location>;

Corners find_corners(const osmium::NodeRefList& ring) {
  Corners corners;
  for (const osmium::NodeRef& node : ring) corners.insert(node.location());
  return corners;
}

bool lies_on(const osmium::Way& way, const Corners& ring) {
  return std::all_of(way.nodes().begin(), way.nodes().end(),
                     [&](const osmium::NodeRef& node) { return ring.contains(node.location()); });
}

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
         std::none_of(kinds.begin(), kinds.end(),
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
  OsmTags of_relation = to_tags(relation.tags());
  of_relation.erase("type");
  std::vector<OsmTags> own;
  for (const osmium::OuterRing& outer : area.outer_rings()) {
    const Corners corners = find_corners(outer);
    OuterRing& ring = rings.emplace_back();
    bool is_first = true;
    for (const osmium::Way* way : ways) {
      if (!lies_on(*way, corners)) continue;
      const OsmTags tags = select_(way->tags());
      if (way->is_closed()) ring.own_way = way->id();
      if (tags.empty()) continue;  // a piece of the outline that somebody has cut
      ring.tags = is_first ? tags : find_common(ring.tags, tags);
      is_first = false;
      replaced_.insert(way->id());
    }
    if (ring.tags.empty()) continue;
    own.push_back(ring.tags);
    for (const osmium::InnerRing& inner : area.inner_rings(outer)) {
      const Corners hole = find_corners(inner);
      for (const osmium::Way* way : ways)
        if (way->is_closed() && lies_on(*way, hole) && select_(way->tags()) == ring.tags)
          replaced_.insert(way->id());
    }
    ring.tags.insert(of_relation.begin(), of_relation.end());
  }
  if (!own.empty()) rings_[relation.id()] = std::move(rings);
}

void OuterWays::add_tagged(const osmium::Relation& relation,
                           const std::vector<const osmium::Way*>& ways, const osmium::Area& area) {
  const OsmTags tags = select_(relation.tags());
  std::size_t rings = 0;
  const osmium::Way* last = nullptr;
  for (const osmium::OuterRing& outer : area.outer_rings()) {
    ++rings;
    Corners corners;
    for (const osmium::Way* way : ways) {
      if (way->tags().empty() || !is_same_thing(tags, select_(way->tags()))) continue;
      if (corners.empty()) corners = find_corners(outer);
      if (!lies_on(*way, corners)) continue;
      replaced_.insert(way->id());
      if (way->is_closed()) last = way;
    }
  }
  if (rings == 1 && last) more_tags_[relation.id()] = to_tags(last->tags());
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
