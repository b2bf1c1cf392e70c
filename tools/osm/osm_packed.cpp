// The only file of this library that includes libosmium: its headers are large.
#include <osmium/io/any_input.hpp>
#include <osmium/osm.hpp>

#include "formats/error.h"
#include "tools/osm/osm_collector.h"
#include "tools/osm/osm_parsers.h"

namespace nightcity {
namespace {

OsmTags tags_of(const osmium::OSMObject& object) {
  OsmTags tags;
  for (const osmium::Tag& tag : object.tags()) tags.emplace(tag.key(), tag.value());
  return tags;
}

void collect(const osmium::memory::Buffer& buffer, OsmCollector& collector) {
  for (const osmium::OSMObject& object : buffer.select<osmium::OSMObject>()) {
    if (object.deleted()) continue;
    if (object.type() == osmium::item_type::node) {
      const auto& node = static_cast<const osmium::Node&>(object);
      if (!node.location().valid())
        collector.count_bad_node();
      else
        collector.add_node(node.id(), {node.location().lon(), node.location().lat()},
                           tags_of(node));
    } else if (object.type() == osmium::item_type::way) {
      const auto& way = static_cast<const osmium::Way&>(object);
      std::vector<std::int64_t> nodes;
      nodes.reserve(way.nodes().size());
      for (const osmium::NodeRef& reference : way.nodes()) nodes.push_back(reference.ref());
      collector.add_way(way.id(), std::move(nodes), tags_of(way));
    } else if (object.type() == osmium::item_type::relation) {
      collector.count_relation();
    }
  }
}

}  // namespace

OsmData read_osm_packed(const std::filesystem::path& file, const std::string& format) {
  OsmCollector collector;
  try {
    osmium::io::Reader reader(osmium::io::File(file.string(), format), osmium::osm_entity_bits::nwr,
                              osmium::io::read_meta::no);
    while (const osmium::memory::Buffer buffer = reader.read()) collect(buffer, collector);
    reader.close();
  } catch (const std::exception& error) {
    // pbf_error, gzip_error, bzip2_error, xml_error and protozero's share no other base.
    throw Error(file.string(), std::string("broken ") + format + ": " + error.what());
  }
  return std::move(collector).finish();
}

}  // namespace nightcity
