// Makes one city object of its parts and installations: chooses their level of detail and removes
// polygons that come twice.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/city/city_reader.h"

namespace nightcity::city {

struct RawPolygon {
  Polygon polygon;
  int lod = -1;             // -1: the file does not say
  std::uint32_t space = 0;  // index into RawObject::spaces
};

/// A building, one of its parts, an installation on it, ...
struct RawSpace {
  bool detail = false;  // an installation: adds to its parent, but cannot stand for it alone
};

struct RawObject {
  CityObject object;  // without polygons
  std::vector<RawSpace> spaces{1};
  std::vector<RawPolygon> polygons;
  bool has_ended = false;  // it was taken out of the model
};

/// Returns the object with the highest LoD up to `options.max_lod` of every space (of a space that
/// has only higher ones, the lowest of them). Leaves out polygons that repeat another's vertices (a
/// solid's copy of a wall). Counts every polygon left out in `report.skipped`, by reason. Buildings
/// that have LoD0 alone become blocks of their measured height (extrude.h). Texts become valid
/// UTF-8.
CityObject merge_parts(RawObject&& raw, const ReadOptions& options, ReadReport& report);

}  // namespace nightcity::city
