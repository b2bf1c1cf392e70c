// Multipolygons whose outer ways have tags: in place of the relation's, or the same ones again.
// Included by the one file that assembles areas, because libosmium is slow to compile.
#pragma once

#include <osmium/osm/area.hpp>
#include <osmium/osm/relation.hpp>
#include <osmium/osm/way.hpp>

#include <functional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "tools/osm/osm_data.h"

namespace nightcity::osm {

/// Returns whether a relation says nothing about what it is, as multipolygons did until 2017: then
/// the tags of its outer ways count (OSM wiki, "Relation:multipolygon", old style).
bool is_untagged_multipolygon(const osmium::Relation& relation);

/// A ring of a multipolygon with what its outer ways say about it, in the order of the area's rings.
struct OuterRing {
  OsmTags tags;              // that are selected, of all its ways; those of the relation added
  std::int64_t own_way = 0;  // the closed way that is the ring; 0: it has several
};

class OuterWays {
 public:
  using Select = std::function<OsmTags(const osmium::TagList&)>;
  /// `select` returns an element's tags if it is wanted, else none. `keys` select.
  OuterWays(Select select, std::vector<std::string> keys)
      : select_(std::move(select)), keys_(std::move(keys)) {}

  /// Looks at the ways of an area that was assembled. `area` is the relation's.
  void add(const osmium::Relation& relation, const std::vector<const osmium::Way*>& ways,
           const osmium::Area& area);

  /// Returns the rings of an untagged multipolygon, null for any other area.
  const std::vector<OuterRing>* find_rings(osmium::object_id_type relation) const;
  /// Returns tags that a tagged multipolygon's only outer way has besides those of the relation.
  const OsmTags* find_more_tags(osmium::object_id_type relation) const;
  /// Ways that are no areas of their own: they are the outlines of multipolygons, or holes that an
  /// untagged one's outer way has the same tags as.
  const std::unordered_set<osmium::object_id_type>& replaced() const { return replaced_; }

 private:
  void add_untagged(const osmium::Relation& relation, const std::vector<const osmium::Way*>& ways,
                    const osmium::Area& area);
  void add_tagged(const osmium::Relation& relation, const std::vector<const osmium::Way*>& ways,
                  const osmium::Area& area);
  bool is_same_thing(const OsmTags& relation, const OsmTags& way) const;

  Select select_;
  std::vector<std::string> keys_;
  std::unordered_map<osmium::object_id_type, std::vector<OuterRing>> rings_;
  std::unordered_map<osmium::object_id_type, OsmTags> more_tags_;
  std::unordered_set<osmium::object_id_type> replaced_;
};

}  // namespace nightcity::osm
