// Streets and squares of a map by their names, for a scene whose user looks for one.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "formats/georeference.h"
#include "formats/scene_places.h"
#include "tools/ground_cover/box_index.h"
#include "tools/osm/map_areas.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"

namespace nightcity::names {

/// Selects squares of a map: place=square, area:highway=*, and highway=* as an area, with a name.
osm::AreaSelection select_squares();

struct NamedStreets {
  std::vector<NamedStreet> streets;  // by name; those of one name that lie apart by place
  std::size_t names = 0, points = 0;
  std::size_t other_names = 0;                  // of the streets (NamedStreet::also)
  std::map<std::string, std::size_t> left_out;  // ways, areas and nodes of the map, by reason
};

/// The map's streets, paths and squares.
struct NamedThings {
  std::span<const osm::OsmWay> highways;
  std::span<const osm::MapArea> squares;  // of select_squares
  std::span<const osm::OsmPoint> square_nodes;
};

/// Returns the centrelines, within a metre, of what has a name and lies within `bounds` (E, N, m):
/// of ways that people use and that are not below the ground. A square is a point inside it. Does
/// not depend on the order of `things`. Other names are those of OSM wiki, "Names": alt_name, int_name,
/// loc_name, nat_name, official_name, old_name, reg_name and short_name, name:LANGUAGE, and the
/// road's number, ref. Of keys that begin with "name:", no others: name:etymology:wikidata is none.
NamedStreets find_named_streets(const NamedThings& things, const place::LonLatToFrame& to_frame,
                                const ground_cover::Box& bounds, const Georeference& georeference);

}  // namespace nightcity::names
