// Assembles areas from ways and relations within bounds: what would take too long is left out.
// Included by the one file that assembles areas, because libosmium is slow to compile.
#pragma once

#include <osmium/area/assembler.hpp>
#include <osmium/handler.hpp>
#include <osmium/memory/buffer.hpp>
#include <osmium/osm/relation.hpp>
#include <osmium/osm/way.hpp>

#include <algorithm>
#include <cstddef>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "tools/osm/area_tags.h"
#include "tools/osm/building_relations.h"
#include "tools/osm/outer_ways.h"

namespace nightcity::osm {

// The ways and relations that an assembler leaves out. The manager makes an assembler for each
// area, from a copy of its configuration.
struct TooLongAreas {
  std::unordered_set<osmium::object_id_type> ways;
  std::size_t relations = 0;
};

// libosmium's assembler of areas, for areas of a bounded number of nodes.
class BoundedAssembler {
 public:
  struct config_type {
    osmium::area::AssemblerConfig assembler;
    std::size_t max_nodes;
    TooLongAreas* too_long;
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

/// Hands relations on that are selected or that their outer ways may select, but for those of a way
/// that others name as well, very often. Relations share borders, but few of them one; and for each
/// that is complete, libosmium looks at all members that any relation has in the same way.
template <class Manager>
class RelationGate : public osmium::handler::Handler {
 public:
  RelationGate(Manager& manager, const AreaSelection& selection, TooLongAreas& too_long)
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
  TooLongAreas& too_long_;
  std::unordered_map<osmium::object_id_type, std::size_t> uses_of_way_;
};

}  // namespace nightcity::osm
