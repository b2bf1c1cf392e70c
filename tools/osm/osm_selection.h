// Selects the OSM elements that a night scene uses. Case, hyphens and blanks in tag values do not
// matter.
#pragma once

#include "tools/osm/osm_data.h"

namespace nightcity::osm {

/// Returns whether the element is a lamp that lights its surroundings, not a signal, beacon or
/// warning light:
/// * highway=street_lamp and its misspellings,
/// * light_source=lantern|floodlight|street_lamp|lamp|electric_lamp|gas_lamp,
/// * tower:type=lighting,
/// * man_made=street_lamp|floodlight|light_mast|...
///
/// One of several values counts too: highway=street_lamp;advertising_column.
bool is_lamp(const OsmTags& tags);
/// Returns whether it has a highway=* that can be a way.
bool is_highway(const OsmTags& tags);
/// Returns whether it is a single tree, and whether a row of trees.
bool is_tree(const OsmTags& tags);
bool is_tree_row(const OsmTags& tags);
/// Returns whether it has barrier=* and is neither a street nor a building.
bool is_barrier(const OsmTags& tags);
/// Returns whether a node on a barrier lets people or vehicles through: barrier=* but "no".
bool is_gate(const OsmTags& tags);
/// Returns whether it may shine without being a lamp: advertising=*, floodlit=*, amenity=fuel,
/// and things of sports, history, art and religion, towers and chimneys that have the tag lit=*,
/// and obstruction lights. Streets are lit by their lamps and do not count.
bool may_shine(const OsmTags& tags);
/// Returns whether it is a pitch, a running track, a stadium or another place of sports.
bool is_sports_ground(const OsmTags& tags);
/// Returns whether it is a light that warns aircraft: one of the values of aeroway=* or
/// light_source=*.
bool is_obstruction_light(const OsmTags& tags);
/// Returns whether it is a mast or a tower of bars and ropes: light passes through it.
bool is_open_tower(const OsmTags& tags);
/// Returns whether it has railway=* but "no": tracks, and what belongs to them.
bool is_railway(const OsmTags& tags);
/// Returns whether a node is a crossing of people on foot: one of the values of highway=*.
bool is_crossing(const OsmTags& tags);
/// Returns whether it is a square of a town: place=square.
bool is_square(const OsmTags& tags);
/// Returns whether a node is a sign or a signal that vehicles stop at.
bool is_control(const OsmTags& tags);
/// Returns whether it has building=* but "no".
bool is_building(const OsmTags& tags);

/// Returns whether a way is the middle of a river, a stream or a canal, or a coast.
bool is_watercourse(const OsmTags& tags);

/// Returns whether the tag `area` says that a closed way is an outline.
bool says_area(const OsmTags& tags);

}  // namespace nightcity::osm
