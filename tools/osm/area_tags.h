// The tags by which areas of a map are selected, as libosmium holds them.
// Included by the one file that assembles areas, because libosmium is slow to compile.
#pragma once

#include <osmium/osm/tag.hpp>

#include <algorithm>
#include <string>

#include "tools/osm/map_areas.h"

namespace nightcity::osm {

inline bool has_key(const osmium::TagList& tags, const AreaSelection& selection) {
  return std::any_of(selection.keys.begin(), selection.keys.end(),
                     [&](const std::string& key) { return tags.has_key(key.c_str()); });
}

/// Returns the tags of an element that is selected, otherwise none. libosmium leaves out the tag
/// `type` of relations, which says that a street is an area.
inline OsmTags select_tags(const osmium::TagList& tags, const AreaSelection& selection,
                           bool is_multipolygon = false) {
  OsmTags out;
  if (!has_key(tags, selection)) return out;
  for (const osmium::Tag& tag : tags) out.emplace(tag.key(), tag.value());
  if (is_multipolygon) out.emplace("type", "multipolygon");
  if (selection.wants && !selection.wants(out)) out.clear();
  return out;
}

}  // namespace nightcity::osm
