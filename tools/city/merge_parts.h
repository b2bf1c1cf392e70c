// One city object out of its spaces (building, parts, installations): which LoD is taken, what is said twice.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/city/city_reader.h"

namespace nightcity::city {

struct RawPolygon {
  Polygon polygon;
  int lod = -1;             // -1: not said
  std::uint32_t space = 0;  // index into RawObject::spaces
};

/// A building, one of its parts, an installation on it, ...
struct RawSpace {
  bool detail = false;  // an installation: adds to its parent, never stands for it
};

struct RawObject {
  CityObject object;  // without polygons
  std::vector<RawSpace> spaces{1};
  std::vector<RawPolygon> polygons;
  bool continued = false;  // a later piece of an object counted already
};

/// Takes of every space its highest LoD up to `options.highest_lod` (a space that has only higher ones: the
/// lowest of them), drops polygons that repeat another's vertices (a solid's copy of a wall), and counts in
/// `report.skipped` every polygon left out, by reason.
CityObject merge_parts(RawObject&& raw, const ReadOptions& options, ReadReport& report);

}  // namespace nightcity::city
