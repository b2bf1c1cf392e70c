#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "tools/osm/osm_collector.h"
#include "tools/osm/osm_document.h"
#include "tools/osm/osm_parsers.h"
#include "tools/osm/osm_selection.h"

namespace nightcity::osm {
namespace {

void collect_node(const pugi::xml_node& element, OsmCollector& collector) {
  const auto id = to_number<std::int64_t>(element.attribute("id").value());
  if (id)
    collector.add_node(*id, read_version(element), read_place(element), read_tags(element));
  else
    collector.count_bad_node();
}

void collect_way(const pugi::xml_node& element, OsmCollector& collector) {
  const auto id = to_number<std::int64_t>(element.attribute("id").value());
  if (!id) return;
  std::vector<OsmNodeRef> nodes;
  for (const pugi::xml_node& reference : element.children("nd"))
    // An unreadable reference counts as a node that the extract lacks.
    nodes.push_back(
        {to_number<std::int64_t>(reference.attribute("ref").value()).value_or(INT64_MIN),
         read_place(reference)});
  OsmTags tags = read_tags(element);
  // Overpass' `out center` gives an area one place instead of its nodes': enough for a lamp.
  if (const pugi::xml_node centre = element.child("center"); centre && is_lamp(tags))
    nodes = {{INT64_MIN, read_place(centre)}};
  collector.add_way(*id, read_version(element), std::move(nodes), std::move(tags));
}

void collect_relation(const pugi::xml_node& element, OsmCollector& collector) {
  const auto id = to_number<std::int64_t>(element.attribute("id").value());
  const OsmVersion version = read_version(element);
  OsmRelation relation{version.deleted ? OsmTags() : read_tags(element), {}, {}};
  if (is_lamp(relation.tags)) {
    if (const pugi::xml_node centre = element.child("center")) relation.centre = read_place(centre);
    for (const pugi::xml_node& from : element.children("member")) {
      const std::string_view type = from.attribute("type").value();
      const auto reference = to_number<std::int64_t>(from.attribute("ref").value());
      if (!reference || (type != "node" && type != "way")) continue;
      OsmMember member{type == "node" ? OsmMember::Type::node : OsmMember::Type::way,
                       *reference,
                       from.attribute("role").value(),
                       {}};
      if (from.attribute("lat")) member.places.push_back(read_place(from));
      for (const pugi::xml_node& place : from.children("nd"))
        member.places.push_back(read_place(place));
      relation.members.push_back(std::move(member));
    }
  }
  collector.add_relation(id.value_or(0), version, std::move(relation));
}

void collect_bounds(const pugi::xml_node& element, OsmCollector& collector) {
  const auto read = [&](const char* name) {
    return to_number<double>(element.attribute(name).value());
  };
  const auto west = read("minlon"), south = read("minlat"), east = read("maxlon"),
             north = read("maxlat");
  if (west && south && east && north) collector.add_bounds({{*west, *south}, {*east, *north}});
}

}  // namespace

void take_remark(const std::filesystem::path& file, std::size_t line, const std::string& text,
                 OsmCollector& collector) {
  if (text.find("error") != std::string::npos)
    throw Error(file.string(), line,
                "the server's answer is incomplete (\"" + text.substr(0, 200) +
                    "\"): ask for a smaller area or a longer timeout");
  collector.add_remark(text);
}

void collect_document(const pugi::xml_node& root, const std::filesystem::path& file,
                      const LineFinder& find_line, OsmCollector& collector) {
  for (const pugi::xml_node& element : root) {
    const std::string_view name = element.name();
    if (name == "node") {
      collect_node(element, collector);
    } else if (name == "way") {
      collect_way(element, collector);
    } else if (name == "relation") {
      collect_relation(element, collector);
    } else if (name == "bounds") {
      collect_bounds(element, collector);
    } else if (name == "action") {
      throw Error(
          file.string(), find_line(element.offset_debug()),
          "is an augmented diff, which holds changes and no map: ask the server for the map "
          "itself (no [adiff:...])");
    } else if (name == "remark") {
      take_remark(file, find_line(element.offset_debug()), element.text().as_string(), collector);
    }
  }
}

void read_osm_xml(const std::filesystem::path& file, OsmCollector& collector) {
  collect_document(
      load_osm_document(file).child("osm"), file,
      [&](std::ptrdiff_t offset) { return line_at(file, offset); }, collector);
}

}  // namespace nightcity::osm
