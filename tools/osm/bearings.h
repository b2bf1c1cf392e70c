// Directions in the tags of things that look or shine some way, as people write them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nightcity::osm {

/// Returns a bearing in degrees clockwise from north, 0 to 360 without 360: "90", "90 deg", "NNE",
/// "south-west". A range (OSM wiki, "Key:direction": "45-100", "NW-NE") runs clockwise and stands
/// for its middle. One of half a turn or more is none: "N-W" may be the north-west, "90-270" two
/// directions.
std::optional<double> parse_bearing_degrees(std::string_view text);

/// The bearings of a list, and those of its parts that are none.
struct Bearings {
  std::vector<double> degrees;
  std::vector<std::string> unread;
};

/// Returns the bearings of a list: "90;270", "90,270", "N / S", "90 & 270". A single comma before
/// one digit is a decimal one ("22,5"): no list of two bearings ends so.
Bearings parse_bearings(std::string_view text);

}  // namespace nightcity::osm
