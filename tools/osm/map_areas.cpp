#include "tools/osm/map_areas.h"

#include <osmium/area/assembler.hpp>
#include <osmium/area/multipolygon_manager.hpp>
#include <osmium/handler/check_order.hpp>
#include <osmium/index/map/flex_mem.hpp>
#include <osmium/io/any_input.hpp>
#include <osmium/visitor.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "tools/osm/arranged_map.h"
#include "tools/osm/building_relations.h"
#include "tools/osm/lifecycle.h"
#include "tools/osm/osm_document.h"
#include "tools/osm/outer_ways.h"
#include "tools/osm/packed_map.h"
#include "tools/osm/whole_tags.h"

namespace nightcity::osm {
namespace {

bool has_key(const osmium::TagList& tags, const AreaSelection& selection) {
  return std::any_of(selection.keys.begin(), selection.keys.end(),
                     [&](const std::string& key) { return tags.has_key(key.c_str()); });
}

// Returns the tags of an element that is selected, otherwise none.
OsmTags select_tags(const osmium::TagList& tags, const AreaSelection& selection) {
  OsmTags out;
  if (!has_key(tags, selection)) return out;
  for (const osmium::Tag& tag : tags) out.emplace(tag.key(), tag.value());
  if (selection.wants && !selection.wants(out)) out.clear();
  return out;
}

// Gives ways the places of their nodes, unless they hold them themselves.
class Places : public osmium::handler::Handler {
 public:
  explicit Places(const AreaSelection& selection) : selection_(selection) {}

  void node(const osmium::Node& node) {
    if (sorted_) throw osmium::out_of_order_error("a node behind a way", node.id());
    if (!node.location().valid()) return;
    if (!select_tags(node.tags(), selection_).empty()) points.insert(node.id());
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
      const bool closed =
          way.nodes().size() > 3 && way.nodes().front().ref() == way.nodes().back().ref();
      (closed ? closed_ways : open_ways).insert(way.id());
    }
    for (osmium::NodeRef& node : way.nodes())
      if (!node.location().valid()) node.set_location(find(node.ref()));
  }

  std::unordered_map<osmium::object_id_type, osmium::object_version_type> deleted_ways;
  std::unordered_set<osmium::object_id_type> closed_ways, open_ways;  // that are selected
  std::unordered_set<osmium::object_id_type> points;                  // that are selected

 private:
  // A reference may be any number, and the smallest has no opposite among the signed ones.
  osmium::Location find(osmium::object_id_type id) const {
    const auto number = static_cast<osmium::unsigned_object_id_type>(id);
    return id < 0 ? of_editor_.get_noexcept(0 - number) : places_.get_noexcept(number);
  }

  const AreaSelection& selection_;
  using Index = osmium::index::map::FlexMem<osmium::unsigned_object_id_type, osmium::Location>;
  Index places_, of_editor_;
  bool sorted_ = false;
};

// The ways and relations that an assembler leaves out. The manager makes an assembler for each
// area, from a copy of its configuration.
struct TooLong {
  std::unordered_set<osmium::object_id_type> ways;
  std::size_t relations = 0;
};

// libosmium's assembler of areas, for areas of a bounded number of nodes.
class BoundedAssembler {
 public:
  struct config_type {
    osmium::area::AssemblerConfig assembler;
    std::size_t max_nodes;
    TooLong* too_long;
    OuterWays* outer_ways;
  };
  explicit BoundedAssembler(const config_type& config)
      : config_(config), assembler_(config.assembler) {}

  void operator()(const osmium::Way& way, osmium::memory::Buffer& out) {
    if (way.nodes().size() > config_.max_nodes)
      config_.too_long->ways.insert(way.id());
    else
      assembler_(way, out);
  }
  void operator()(const osmium::Relation& relation, const std::vector<const osmium::Way*>& ways,
                  osmium::memory::Buffer& out) {
    std::size_t nodes = 0;
    for (const osmium::Way* way : ways) nodes += way->nodes().size();
    if (nodes > config_.max_nodes) {
      ++config_.too_long->relations;
      return;
    }
    const std::size_t begin = out.committed();
    if (assembler_(relation, ways, out) && out.committed() > begin)
      config_.outer_ways->add(relation, ways, out.get<osmium::Area>(begin));
  }
  const osmium::area::area_stats& stats() const { return assembler_.stats(); }

 private:
  config_type config_;
  osmium::area::Assembler assembler_;
};

// Hands relations on that are selected or that their outer ways may select, but for those of a way
// that others name as well, very often. Relations share
// borders, but few of them one; and for each that is complete, libosmium looks at all members that
// any relation has in the same way.
template <class Manager>
class RelationGate : public osmium::handler::Handler {
 public:
  RelationGate(Manager& manager, const AreaSelection& selection, TooLong& too_long)
      : manager_(manager), selection_(selection), too_long_(too_long) {}

  void relation(const osmium::Relation& relation) {
    if (!has_key(relation.tags(), selection_) && !is_untagged_multipolygon(relation)) return;
    if (names_way_zero(relation)) {
      ++unsound;
      return;
    }
    if (is_building_relation(relation)) {
      const osmium::memory::Buffer outline = make_outline_multipolygon(relation);
      hand_on(outline.get<osmium::Relation>(0));
    } else {
      hand_on(relation);
    }
  }

  std::size_t unsound = 0;  // relations

 private:
  void hand_on(const osmium::Relation& relation) {
    constexpr std::size_t max_uses = 64;
    std::size_t uses = 0;
    if (manager_.new_relation(relation))
      for (const osmium::RelationMember& member : relation.members())
        if (member.type() == osmium::item_type::way)
          uses = std::max(uses, ++uses_of_way_[member.ref()]);
    if (uses > max_uses)
      ++too_long_.relations;
    else
      manager_.relation(relation);
  }

  // libosmium marks members that are none of an area's by the number 0, and leaves a way of that
  // number out of a list that it then reads as long as with it.
  static bool names_way_zero(const osmium::Relation& relation) {
    return std::any_of(relation.members().begin(), relation.members().end(),
                       [](const osmium::RelationMember& member) {
                         return member.type() == osmium::item_type::way && member.ref() == 0;
                       });
  }

  Manager& manager_;
  const AreaSelection& selection_;
  TooLong& too_long_;
  std::unordered_map<osmium::object_id_type, std::size_t> uses_of_way_;
};

class Collector : public osmium::handler::Handler {
 public:
  Collector(const AreaSelection& selection, const OuterWays& outer_ways)
      : selection_(selection), outer_ways_(outer_ways) {}

  void area(const osmium::Area& area) {
    const bool from_way = area.from_way();
    const std::vector<OuterRing>* untagged =
        from_way ? nullptr : outer_ways_.find_rings(area.orig_id());
    MapArea whole{(from_way ? "way/" : "relation/") + std::to_string(area.orig_id()),
                  select_tags(area.tags(), selection_),
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
  MapAreas finish(const Places& places, const TooLong& too_long) && {
    areas.too_long = too_long.ways.size() + too_long.relations;
    for (const auto& [id, version] : places.deleted_ways) {
      const auto known = newest_.find(osmium::object_id_to_area_id(id, osmium::item_type::way));
      if (known != newest_.end() && known->second.version < version) clear(known->second);
    }
    for (const auto id : outer_ways_.replaced())
      if (const auto known = newest_.find(osmium::object_id_to_area_id(id, osmium::item_type::way));
          known != newest_.end())
        clear(known->second);
    const auto is_missing = [&](osmium::object_id_type id) {
      return !made_ways_.contains(id) && !places.deleted_ways.contains(id) &&
             !too_long.ways.contains(id) && !outer_ways_.replaced().contains(id);
    };
    for (const auto id : places.closed_ways) areas.broken += is_missing(id);
    for (const auto id : places.open_ways) areas.open_ways += is_missing(id);
    std::erase_if(areas.areas, [](const MapArea& area) { return area.rings.empty(); });
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

  static std::vector<glm::dvec2> copy(const osmium::NodeRefList& ring) {
    std::vector<glm::dvec2> out;
    for (const osmium::NodeRef& node : ring) {
      const glm::dvec2 p(node.location().lon(), node.location().lat());
      if (out.empty() || out.back() != p) out.push_back(p);
    }
    while (out.size() > 1 && out.back() == out.front()) out.pop_back();
    return out;
  }

  const AreaSelection& selection_;
  const OuterWays& outer_ways_;
  std::unordered_map<osmium::object_id_type, State> newest_;
  std::unordered_set<osmium::object_id_type> made_ways_;
};

// Returns how many nodes of a document are selected.
std::size_t count_points(const pugi::xml_node& root, const AreaSelection& selection) {
  std::size_t count = 0;
  for (const pugi::xml_node& node : root.children("node")) {
    if (!node.child("tag") || read_version(node).deleted) continue;
    const OsmTags tags = read_tags(node);
    const auto is_said = [&](const std::string& key) { return tags.contains(key); };
    count += std::any_of(selection.keys.begin(), selection.keys.end(), is_said) &&
             (!selection.wants || selection.wants(tags));
  }
  return count;
}

template <class Work>
auto guard(const std::filesystem::path& file, const Work& work) {
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(file.string(), std::string("broken map: ") + error.what());
  }
}

}  // namespace

namespace {

enum class Order : std::uint8_t { usual, any };

MapAreas read_areas(const std::filesystem::path& file, const AreaSelection& selection,
                    std::size_t max_nodes, Order order) {
  osmium::TagsFilter filter{false};
  for (const std::string& key : selection.keys) filter.add_rule(true, key);
  filter.add_rule(true, "type", "multipolygon");  // the gate looks at the other tags
  TooLong too_long;
  OuterWays outer_ways([&](const osmium::TagList& tags) { return select_tags(tags, selection); },
                       selection.keys);
  osmium::area::MultipolygonManager<BoundedAssembler> manager{
      {{}, max_nodes, &too_long, &outer_ways}, filter};
  ObjectCheck check;
  RelationGate gate(manager, selection, too_long);
  Places places(selection);
  Collector collector(selection, outer_ways);
  const auto collect = [&](osmium::memory::Buffer&& buffer) { osmium::apply(buffer, collector); };
  std::size_t points = 0;
  if (const auto document = find_osm_document(file)) {
    points = count_points(document->child("osm"), selection);
    ArrangedMap map = arrange_map(document->child("osm"));
    osmium::apply(map.relations, gate);
    manager.prepare_for_lookup();
    osmium::apply(map.ways, places, manager.handler(collect));
  } else if (order == Order::any) {
    SortedMap map(file);
    map.apply_to(check, gate);
    manager.prepare_for_lookup();
    map.apply_to(places, manager.handler(collect));
  } else {
    const osmium::io::File packed = open_packed_map(file);
    osmium::io::Reader relations(packed, osmium::osm_entity_bits::relation);
    osmium::apply(relations, check, gate);
    relations.close();
    manager.prepare_for_lookup();
    osmium::io::Reader reader(packed, osmium::osm_entity_bits::nwr, osmium::io::read_meta::yes);
    osmium::apply(reader, check, places, manager.handler(collect));
    reader.close();
  }
  MapAreas areas = std::move(collector).finish(places, too_long);
  areas.points = points + places.points.size();
  std::size_t incomplete = 0;
  manager.for_each_incomplete_relation([&](const osmium::relations::RelationHandle& handle) {
    incomplete += has_key(handle->tags(), selection);
  });
  areas.broken += incomplete + gate.unsound;
  return areas;
}

}  // namespace

MapAreas read_map_areas(const std::filesystem::path& file, const AreaSelection& selection,
                        std::size_t max_nodes) {
  return guard(file, [&] {
    try {
      return read_areas(file, selection, max_nodes, Order::usual);
    } catch (const osmium::out_of_order_error&) {
      return read_areas(file, selection, max_nodes, Order::any);
    }
  });
}

namespace {

void take_places(const pugi::xml_node& parent, const char* name, std::vector<glm::dvec2>& places,
                 std::size_t count) {
  for (const pugi::xml_node& element : parent.children(name)) {
    if (places.size() >= count) return;
    const glm::dvec2 place = read_place(element);
    if (std::abs(place.x) <= 180 && std::abs(place.y) <= 90) places.push_back(place);
  }
}

}  // namespace

std::vector<glm::dvec2> read_first_nodes(const std::filesystem::path& file, std::size_t count) {
  return guard(file, [&] {
    std::vector<glm::dvec2> places;
    if (const auto document = find_osm_document(file)) {
      const pugi::xml_node root = document->child("osm");
      take_places(root, "node", places, count);
      for (const pugi::xml_node& way : root.children("way")) take_places(way, "nd", places, count);
      for (const pugi::xml_node& relation : root.children("relation"))
        for (const pugi::xml_node& member : relation.children("member"))
          take_places(member, "nd", places, count);
      return places;
    }
    osmium::io::Reader reader(open_packed_map(file), osmium::osm_entity_bits::nwr);
    const auto take = [&](const osmium::Location& place) {
      if (place.valid() && places.size() < count) places.emplace_back(place.lon(), place.lat());
    };
    while (places.size() < count) {
      const osmium::memory::Buffer buffer = reader.read();
      if (!buffer) break;
      for (const osmium::Node& node : buffer.select<osmium::Node>()) take(node.location());
      for (const osmium::Way& way : buffer.select<osmium::Way>())
        for (const osmium::NodeRef& node : way.nodes()) take(node.location());
    }
    reader.close();
    return places;
  });
}

}  // namespace nightcity::osm
