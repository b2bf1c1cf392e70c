// Maps that libosmium reads: PBF, o5m, and XML packed by gzip or bzip2.
#include <osmium/io/any_input.hpp>
#include <osmium/osm.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "tools/osm/osm_collector.h"
#include "tools/osm/osm_document.h"
#include "tools/osm/osm_parsers.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/packed_map.h"
#include "tools/osm/whole_tags.h"

namespace nightcity::osm {
namespace {

OsmTags tags_of(const osmium::OSMObject& object) {
  require_whole_tags(object.tags());
  OsmTags tags;
  for (const osmium::Tag& tag : object.tags()) tags.emplace(tag.key(), tag.value());
  return tags;
}

OsmVersion version_of(const osmium::OSMObject& object) {
  return {object.version(), false, object.deleted()};
}

void collect_relation(const osmium::Relation& from, OsmCollector& collector) {
  OsmRelation relation{from.deleted() ? OsmTags() : tags_of(from), {}, {}};
  if (is_lamp(relation.tags))
    for (const osmium::RelationMember& member : from.members())
      if (member.type() == osmium::item_type::node || member.type() == osmium::item_type::way)
        relation.members.push_back({member.type() == osmium::item_type::node ? OsmMember::Type::node
                                                                             : OsmMember::Type::way,
                                    member.ref(),
                                    member.role(),
                                    {}});
  collector.add_relation(from.id(), version_of(from), std::move(relation));
}

void collect(const osmium::memory::Buffer& buffer, OsmCollector& collector) {
  for (const osmium::OSMObject& object : buffer.select<osmium::OSMObject>()) {
    if (object.type() == osmium::item_type::node) {
      const auto& node = static_cast<const osmium::Node&>(object);
      if (object.deleted())
        collector.add_node(node.id(), version_of(node), {}, {});
      else if (!node.location().valid())
        collector.count_bad_node();
      else
        collector.add_node(node.id(), version_of(node),
                           {node.location().lon(), node.location().lat()}, tags_of(node));
    } else if (object.type() == osmium::item_type::way) {
      const auto& way = static_cast<const osmium::Way&>(object);
      std::vector<OsmNodeRef> nodes;
      nodes.reserve(way.nodes().size());
      for (const osmium::NodeRef& reference : way.nodes()) {
        nodes.push_back({reference.ref()});
        if (reference.location().valid())
          nodes.back().lon_lat = {reference.location().lon(), reference.location().lat()};
      }
      collector.add_way(way.id(), version_of(way), std::move(nodes), tags_of(way));
    } else if (object.type() == osmium::item_type::relation) {
      collect_relation(static_cast<const osmium::Relation&>(object), collector);
    }
  }
}

}  // namespace

void read_osm_packed(const std::filesystem::path& file, const std::string& format,
                     OsmCollector& collector) {
  if (std::optional<std::string> text = unpack_answer(file))
    return collect_document(
        parse_osm_document(*text, file).child("osm"), file,
        [](std::ptrdiff_t) { return std::size_t{0}; }, collector);
  try {
    // Versions are part of what libosmium calls metadata.
    osmium::io::Reader reader(open_packed_map(file, format), osmium::osm_entity_bits::nwr,
                              osmium::io::read_meta::yes);
    const osmium::io::Header header = reader.header();
    for (const osmium::Box& box : header.boxes())
      if (box.valid())
        collector.add_bounds({{box.bottom_left().lon(), box.bottom_left().lat()},
                              {box.top_right().lon(), box.top_right().lat()}});
    while (const osmium::memory::Buffer buffer = reader.read()) collect(buffer, collector);
    reader.close();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    // pbf_error, gzip_error, bzip2_error, xml_error and protozero's share no other base.
    const std::string_view what = error.what();
    for (const char* packing : {"lz4", "lzma", "zstd"})
      if (what.find(packing) != what.npos)
        throw Error(file.string(), std::string("is a PBF packed by ") + packing +
                                       ", which is not read: repack it by `osmium cat IN.osm.pbf "
                                       "-o OUT.osm.pbf`");
    throw Error(file.string(), "broken " + format + ": " + error.what());
  }
}

}  // namespace nightcity::osm
