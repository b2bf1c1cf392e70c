// The places of a map's nodes, for the ways that areas are made of, and what is selected.
// Included by the one file that assembles areas, because libosmium is slow to compile.
#pragma once

#include <osmium/handler.hpp>
#include <osmium/handler/check_order.hpp>
#include <osmium/index/map/flex_mem.hpp>
#include <osmium/osm/node.hpp>
#include <osmium/osm/way.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <unordered_map>
#include <unordered_set>

#include "tools/osm/area_tags.h"
#include "tools/osm/selected_points.h"

namespace nightcity::osm {

/// Gives ways the places of their nodes, unless they hold them themselves. A map that lies on the
/// far side of the globe is turned by 180 degrees, so that areas across the antimeridian are whole.
class AreaPlaces : public osmium::handler::Handler {
 public:
  AreaPlaces(const AreaSelection& selection, SelectedPoints& points)
      : selection_(selection), points_(points) {}

  void node(const osmium::Node& node) {
    if (sorted_) throw osmium::out_of_order_error("a node behind a way", node.id());
    if (node.deleted()) points_.add(node.id(), node.version(), {}, {});
    if (!node.location().valid()) return;
    points_.add(node.id(), node.version(), {node.location().lon(), node.location().lat()},
                select_tags(node.tags(), selection_));
    balance_ += lies_beyond(node.location()) ? 1 : -1;
    (node.id() < 0 ? of_editor_ : places_).set(node.positive_id(), node.location());
  }

  void way(osmium::Way& way) {
    if (!sorted_) {
      places_.sort();
      of_editor_.sort();
      sorted_ = true;
    }
    if (way.deleted()) {
      auto& version = deleted_ways[way.id()];
      version = std::max(version, way.version());
    } else if (!select_tags(way.tags(), selection_).empty()) {
      // A server that was asked for tags alone sends ways without nodes: what lacks them may be
      // closed. One that goes to a place and back encloses nothing.
      const bool closed =
          way.nodes().empty() || way.nodes().front().ref() == way.nodes().back().ref();
      (closed ? closed_ways : open_ways).insert(way.id());
    }
    for (osmium::NodeRef& node : way.nodes()) {
      if (!node.location().valid()) node.set_location(find(node.ref()));
      if (!node.location().valid()) continue;
      // Maps without nodes have their places in ways: the first one decides.
      if (balance_ == 0) balance_ = lies_beyond(node.location()) ? 1 : -1;
      if (is_turned()) node.set_location(turn(node.location()));
    }
  }

  bool is_turned() const { return balance_ > 0; }
  /// Returns the place that a node of the map has.
  osmium::Location find_own(const osmium::Location& place) const {
    return is_turned() ? turn(place) : place;
  }

  std::unordered_map<osmium::object_id_type, osmium::object_version_type> deleted_ways;
  std::unordered_set<osmium::object_id_type> closed_ways, open_ways;  // that are selected

 private:
  static constexpr std::int32_t half_turn = 180 * osmium::detail::coordinate_precision;

  static bool lies_beyond(const osmium::Location& place) {
    return std::abs(place.x()) > half_turn / 2;
  }
  static osmium::Location turn(const osmium::Location& place) {
    return {place.x() > 0 ? place.x() - half_turn : place.x() + half_turn, place.y()};
  }

  // A reference may be any number, and the smallest has no opposite among the signed ones.
  osmium::Location find(osmium::object_id_type id) const {
    const auto number = static_cast<osmium::unsigned_object_id_type>(id);
    return id < 0 ? of_editor_.get_noexcept(0 - number) : places_.get_noexcept(number);
  }

  const AreaSelection& selection_;
  SelectedPoints& points_;
  using Index = osmium::index::map::FlexMem<osmium::unsigned_object_id_type, osmium::Location>;
  Index places_, of_editor_;
  std::int64_t balance_ = 0;  // nodes beyond 90 degrees east or west, less the others
  bool sorted_ = false;
};

}  // namespace nightcity::osm
