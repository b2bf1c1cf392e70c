// Makes one city object of its parts and installations: chooses their level of detail and removes
// polygons that come twice.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "tools/city/city_reader.h"
#include "tools/city/named_heights.h"
#include "tools/city/skip_counter.h"

namespace nightcity::city {

/// The polygons of all levels of detail and spaces. They lie as the object is to have them, so that
/// those of an object that loses none need not be moved.
class RawPolygons {
 public:
  struct Place {
    int lod = -1;             // -1: the file does not say
    std::uint32_t space = 0;  // index into RawObject::spaces
  };

  /// Returns the new polygon, to be filled where it stays.
  Polygon& add(Place place) {
    places_.push_back(place);
    return polygons_.emplace_back();
  }
  void add(Polygon&& polygon, Place place) {
    places_.push_back(place);
    polygons_.push_back(std::move(polygon));
  }
  /// Takes the last polygon away again.
  void drop_last() {
    places_.pop_back();
    polygons_.pop_back();
  }
  /// Makes room for `more`, and for as many as there are: each geometry of an object asks.
  void make_room(std::size_t more) {
    if (polygons_.capacity() - polygons_.size() >= more) return;
    polygons_.reserve(size() + std::max(size(), more));
    places_.reserve(polygons_.capacity());
  }

  std::size_t size() const { return polygons_.size(); }
  bool empty() const { return polygons_.empty(); }
  Polygon& operator[](std::size_t i) { return polygons_[i]; }
  const std::vector<Polygon>& polygons() const { return polygons_; }
  std::vector<Polygon>& polygons() { return polygons_; }
  const std::vector<Place>& places() const { return places_; }  // beside them

 private:
  std::vector<Polygon> polygons_;
  std::vector<Place> places_;
};

/// A building, one of its parts, an installation on it, ...
struct RawSpace {
  bool detail = false;  // an installation: adds to its parent, but cannot stand for it alone
};

struct RawObject {
  CityObject object;  // without polygons
  std::vector<RawSpace> spaces{1};
  RawPolygons polygons;
  /// Says why it is left out whole, as it is counted (end_date.h); null: it is not.
  const char* left_out = nullptr;
  /// The height of its roof above its ground by elevations that it states, in the unit of the CRS's
  /// heights. It stands for the measured height where there is none.
  std::optional<double> elevation_span;
  /// Stand for the measured height of a building that has LoD0 alone and states no other height.
  NamedHeights named_heights{};
};

/// Returns the object with the highest LoD up to `options.max_lod` of every space (of a space that
/// has only higher ones, the lowest of them). Leaves out polygons that repeat another's vertices (a
/// solid's copy of a wall). Counts every polygon left out in `report.skipped`, by reason. Buildings
/// that have LoD0 alone become blocks of their measured height or storeys (extrude.h). Texts become
/// valid UTF-8.
CityObject merge_parts(RawObject&& raw, const ReadOptions& options, ReadReport& report);

/// Counts an object that is left out whole, and its polygons.
void count_left_out(const RawObject& raw, SkipCounter& skipped);

}  // namespace nightcity::city
