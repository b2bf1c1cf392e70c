// The keys that say what a thing of a map is.
#pragma once

#include <array>
#include <string_view>

namespace nightcity::osm {

/// A relation with one of these speaks for itself.
inline constexpr std::array<std::string_view, 32> kind_keys = {
    "building", "building:part", "landuse",   "landcover",       "natural", "leisure",  "amenity",
    "highway",  "area:highway",  "waterway",  "water",           "wetland", "boundary", "place",
    "man_made", "tourism",       "historic",  "barrier",         "railway", "aeroway",  "shop",
    "office",   "power",         "military",  "indoor",          "sport",   "parking",  "craft",
    "club",     "healthcare",    "emergency", "public_transport"};

}  // namespace nightcity::osm
