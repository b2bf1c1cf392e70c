#include "tools/osm/map_areas.h"

#include <osmium/area/multipolygon_manager.hpp>
#include <osmium/io/any_input.hpp>
#include <osmium/visitor.hpp>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "tools/osm/area_collector.h"
#include "tools/osm/area_places.h"
#include "tools/osm/area_tags.h"
#include "tools/osm/arranged_map.h"
#include "tools/osm/bounded_assembly.h"
#include "tools/osm/map_file.h"
#include "tools/osm/osm_document.h"
#include "tools/osm/outer_ways.h"
#include "tools/osm/packed_map.h"
#include "tools/osm/read_guarded.h"
#include "tools/osm/selected_points.h"
#include "tools/osm/whole_tags.h"

namespace nightcity::osm {
namespace {

// Passes the nodes of a document that are selected to `points`, then the other versions of these.
void collect_points(const pugi::xml_node& root, const AreaSelection& selection,
                    SelectedPoints& points) {
  const auto is_wanted = [&](const OsmTags& tags) {
    const auto is_said = [&](const std::string& key) { return tags.contains(key); };
    return std::any_of(selection.keys.begin(), selection.keys.end(), is_said) &&
           (!selection.wants || selection.wants(tags));
  };
  for (const bool is_selected : {true, false})
    for (const pugi::xml_node& node : root.children("node")) {
      if (is_selected ? !node.child("tag") : points.is_empty()) continue;
      const auto id = to_number<std::int64_t>(node.attribute("id").value());
      if (!id || (!is_selected && !points.knows(*id))) continue;
      const OsmVersion version = read_version(node);
      OsmTags tags = version.deleted ? OsmTags() : read_tags(node);
      const bool wanted = !tags.empty() && is_wanted(tags);
      if (wanted == is_selected)
        points.add(*id, version.rank(), read_place(node), wanted ? std::move(tags) : OsmTags());
    }
}

enum class Order : std::uint8_t { usual, any };

MapAreas read_areas(const std::filesystem::path& file, const AreaSelection& selection,
                    std::size_t max_nodes, Order order) {
  osmium::TagsFilter filter{false};
  for (const std::string& key : selection.keys) filter.add_rule(true, key);
  filter.add_rule(true, "type", "multipolygon");  // the gate looks at the other tags
  TooLongAreas too_long;
  OuterWays outer_ways([&](const osmium::TagList& tags) { return select_tags(tags, selection); },
                       selection.keys);
  osmium::area::MultipolygonManager<BoundedAssembler> manager{
      {{}, max_nodes, &too_long, &outer_ways}, filter};
  ObjectCheck check;
  RelationGate gate(manager, selection, too_long);
  SelectedPoints points(selection);
  AreaPlaces places(selection, points);
  AreaCollector collector(selection, outer_ways, places);
  const auto collect = [&](osmium::memory::Buffer&& buffer) { osmium::apply(buffer, collector); };
  if (const auto document = find_osm_document(file)) {
    collect_points(document->child("osm"), selection, points);
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
  MapAreas areas = std::move(collector).finish(too_long, std::move(points));
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
  return read_map_file(file, [&](const std::filesystem::path& plain) {
    return read_guarded(plain, [&] {
      try {
        return read_areas(plain, selection, max_nodes, Order::usual);
      } catch (const osmium::out_of_order_error&) {
        return read_areas(plain, selection, max_nodes, Order::any);
      }
    });
  });
}

}  // namespace nightcity::osm
