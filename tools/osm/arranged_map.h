// OSM XML in the order and form that libosmium's assembler of areas asks for.
#pragma once

#include <osmium/memory/buffer.hpp>

#include <pugixml.hpp>

namespace nightcity::osm {

/// Ways, then relations, each by their ids as osmium sorts them, and each in its newest version;
/// what is deleted is left out. The nodes of ways hold their places, where the file has them. Ways
/// that a relation alone describes (Overpass' `out geom`) are among them.
struct ArrangedMap {
  osmium::memory::Buffer ways, relations;
};

/// `root`: of a document of OSM XML.
ArrangedMap arrange_map(const pugi::xml_node& root);

}  // namespace nightcity::osm
