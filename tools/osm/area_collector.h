// Collects the areas that were assembled: of each its newest version, with its tags and rings.
// Included by the one file that assembles areas, because libosmium is slow to compile.
#pragma once

#include <osmium/handler.hpp>
#include <osmium/osm/area.hpp>

#include <glm/vec2.hpp>
#include <iterator>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "tools/osm/area_places.h"
#include "tools/osm/area_tags.h"
#include "tools/osm/bounded_assembly.h"
#include "tools/osm/lifecycle.h"
#include "tools/osm/outer_ways.h"

namespace nightcity::osm {

class AreaCollector : public osmium::handler::Handler {
 public:
  AreaCollector(const AreaSelection& selection, const OuterWays& outer_ways,
                const AreaPlaces& places)
      : selection_(selection), outer_ways_(outer_ways), places_(places) {}

  void area(const osmium::Area& area) {
    const bool from_way = area.from_way();
    const std::vector<OuterRing>* untagged =
        from_way ? nullptr : outer_ways_.find_rings(area.orig_id());
    MapArea whole{(from_way ? "way/" : "relation/") + std::to_string(area.orig_id()),
                  select_tags(area.tags(), selection_, !from_way),
                  {}};
    if (!from_way && !untagged)
      if (const OsmTags* more = outer_ways_.find_more_tags(area.orig_id()))
        whole.tags.insert(more->begin(), more->end());
    if (whole.tags.empty() && !untagged) return;
    std::vector<MapArea> made;
    std::size_t number = 0;
    bool is_empty = true;
    for (const osmium::OuterRing& outer : area.outer_rings()) {
      const OuterRing* own = untagged ? &(*untagged)[number++] : nullptr;
      if (own && own->tags.empty()) continue;
      MapRings rings;
      rings.outer = copy(outer);
      for (const osmium::InnerRing& inner : area.inner_rings(outer))
        rings.holes.push_back(copy(inner));
      if (rings.outer.size() < 3) continue;
      is_empty = false;
      if (own && own->own_way != 0) {
        made.push_back({"way/" + std::to_string(own->own_way), own->tags, {std::move(rings)}});
      } else {
        if (own && whole.tags.empty()) whole.tags = own->tags;
        whole.rings.push_back(std::move(rings));
      }
    }
    if (is_empty) {
      areas.broken += !from_way;  // ways are counted at the end
      return;
    }
    if (!whole.rings.empty()) made.push_back(std::move(whole));
    if (selection_.day)
      areas.gone += std::erase_if(
          made, [&](const MapArea& one) { return is_gone(one.tags, *selection_.day); });
    if (from_way) made_ways_.insert(area.orig_id());
    // A history has several versions of an area: the newest counts.
    std::vector<MapArea>& list = areas.areas;
    const State state{area.version(), list.size(), list.size() + made.size()};
    const auto [known, is_new] = newest_.try_emplace(area.id(), state);
    if (!is_new) {
      if (area.version() < known->second.version) return;
      clear(known->second);
      known->second = state;
    }
    std::move(made.begin(), made.end(), std::back_inserter(list));
  }

  // Removes what newer versions have replaced or deleted.
  MapAreas finish(const TooLongAreas& too_long, SelectedPoints&& points) && {
    areas.points = points.count();
    areas.kept_points = std::move(points).take();
    areas.too_long = too_long.ways.size() + too_long.relations;
    for (const auto& [id, version] : places_.deleted_ways) {
      const auto known = newest_.find(osmium::object_id_to_area_id(id, osmium::item_type::way));
      if (known != newest_.end() && known->second.version < version) clear(known->second);
    }
    for (const auto id : outer_ways_.replaced()) {
      areas.replaced.push_back("way/" + std::to_string(id));
      if (const auto known = newest_.find(osmium::object_id_to_area_id(id, osmium::item_type::way));
          known != newest_.end())
        clear(known->second);
    }
    const auto is_missing = [&](osmium::object_id_type id) {
      return !made_ways_.contains(id) && !places_.deleted_ways.contains(id) &&
             !too_long.ways.contains(id) && !outer_ways_.replaced().contains(id);
    };
    for (const auto id : places_.closed_ways) areas.broken += is_missing(id);
    for (const auto id : places_.open_ways) areas.open_ways += is_missing(id);
    std::erase_if(areas.areas, [](const MapArea& area) { return area.rings.empty(); });
    if (is_east_ && is_west_) count_on(areas);
    return std::move(areas);
  }

  MapAreas areas;

 private:
  struct State {
    osmium::object_version_type version;
    std::size_t begin, end;  // of its areas
  };

  void clear(const State& state) {
    for (std::size_t n = state.begin; n < state.end; ++n) areas.areas[n].rings.clear();
  }

  // Counts the longitudes in the west of a map across the antimeridian on beyond 180 degrees.
  static void count_on(MapAreas& areas) {
    const auto turn = [](std::vector<glm::dvec2>& ring) {
      for (glm::dvec2& p : ring)
        if (p.x < 0) p.x += 360;
    };
    for (MapPoint& point : areas.kept_points)
      if (point.lon_lat.x < 0) point.lon_lat.x += 360;
    for (MapArea& area : areas.areas)
      for (MapRings& rings : area.rings) {
        turn(rings.outer);
        for (std::vector<glm::dvec2>& hole : rings.holes) turn(hole);
      }
  }

  std::vector<glm::dvec2> copy(const osmium::NodeRefList& ring) {
    std::vector<glm::dvec2> out;
    for (const osmium::NodeRef& node : ring) {
      const osmium::Location place = places_.find_own(node.location());
      const glm::dvec2 p(place.lon(), place.lat());
      if (places_.is_turned()) (p.x > 0 ? is_east_ : is_west_) = true;
      if (out.empty() || out.back() != p) out.push_back(p);
    }
    while (out.size() > 1 && out.back() == out.front()) out.pop_back();
    return out;
  }

  const AreaSelection& selection_;
  const OuterWays& outer_ways_;
  const AreaPlaces& places_;
  bool is_east_ = false, is_west_ = false;  // on the far side of the globe
  std::unordered_map<osmium::object_id_type, State> newest_;
  std::unordered_set<osmium::object_id_type> made_ways_;
};

}  // namespace nightcity::osm
