// Relations of type=building that say themselves what stands there.
// Included by the one file that assembles areas, because libosmium is slow to compile.
#pragma once

#include <osmium/memory/buffer.hpp>
#include <osmium/osm/relation.hpp>

namespace nightcity::osm {

/// Returns whether a relation is of the type that groups the outline and the parts of a building
/// (OSM wiki, "Relation:building"), and has a tag `building` of its own.
bool is_building_relation(const osmium::Relation& relation);

/// Returns the relation's outline, with its tags, as a multipolygon: members of the role "outline"
/// are its outer ways. Parts are areas of their own. The buffer holds one relation.
osmium::memory::Buffer make_outline_multipolygon(const osmium::Relation& relation);

}  // namespace nightcity::osm
