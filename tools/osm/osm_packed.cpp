// The only file of this library that includes libosmium: its headers are large.
#include <osmium/io/any_input.hpp>
#include <osmium/osm.hpp>

#include <string>
#include <string_view>

#include "formats/error.h"
#include "tools/osm/osm_collector.h"
#include "tools/osm/osm_parsers.h"
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
    } else if (object.type() == osmium::item_type::relation && !object.deleted()) {
      collector.add_relation(tags_of(object));
    }
  }
}

// libosmium passes over remarks. Only Overpass writes any, and names itself in the root element, so
// nothing else is unpacked a second time.
void read_remarks(const std::filesystem::path& file, osmium::io::file_compression compression,
                  OsmCollector& collector) {
  constexpr std::string_view begin = "<remark>", end = "</remark>";
  constexpr std::size_t max_remark = 10'000, root_bytes = 4096;
  const int descriptor = osmium::io::detail::open_for_reading(file.string());
  const auto source =
      osmium::io::CompressionFactory::instance().create_decompressor(compression, descriptor);
  std::string text = source->read();
  if (text.substr(0, root_bytes).find("Overpass") != std::string::npos) {
    for (std::string block = source->read(); !block.empty() || !text.empty();
         block = source->read()) {
      text += block;
      for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin)) {
        const std::size_t close = text.find(end, at);
        if (close == std::string::npos) break;
        take_remark(file, 0, text.substr(at + begin.size(), close - at - begin.size()), collector);
        text.erase(0, close + end.size());
      }
      if (block.empty()) break;
      // A remark may lie across the border of two blocks.
      if (text.size() > max_remark) text.erase(0, text.size() - max_remark);
    }
  }
  source->close();
}

}  // namespace

void read_osm_packed(const std::filesystem::path& file, const std::string& format,
                     OsmCollector& collector) {
  try {
    // Versions are part of what libosmium calls metadata.
    osmium::io::Reader reader(osmium::io::File(file.string(), format), osmium::osm_entity_bits::nwr,
                              osmium::io::read_meta::yes);
    while (const osmium::memory::Buffer buffer = reader.read()) collect(buffer, collector);
    reader.close();
    if (format == "osm.gz") read_remarks(file, osmium::io::file_compression::gzip, collector);
    if (format == "osm.bz2") read_remarks(file, osmium::io::file_compression::bzip2, collector);
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
