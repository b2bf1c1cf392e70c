#include <algorithm>
#include <charconv>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "formats/error.h"
#include "tools/osm/osm_collector.h"
#include "tools/osm/osm_parsers.h"
#include "tools/osm/osm_selection.h"

namespace nightcity::osm {
namespace {

/// Returns the whole text as a number, or none: "52.5x" and "" are no coordinates.
template <class Number>
std::optional<Number> number(const char* text) {
  Number value{};
  const char* end = text + std::strlen(text);
  const auto [stop, error] = std::from_chars(text, end, value);
  if (error != std::errc() || stop != end || text == end) return std::nullopt;
  return value;
}

OsmTags tags_of(const pugi::xml_node& element) {
  OsmTags tags;
  for (const pugi::xml_node& tag : element.children("tag"))
    tags.emplace(tag.attribute("k").value(), tag.attribute("v").value());
  return tags;
}

/// Editors keep what a user has deleted until it is uploaded.
OsmVersion version_of(const pugi::xml_node& element) {
  const std::string_view action = element.attribute("action").value();
  return {number<std::uint32_t>(element.attribute("version").value()).value_or(0), !action.empty(),
          action == "delete" || std::string_view(element.attribute("visible").value()) == "false"};
}

/// Returns the place of a node, or of a way's reference to a node; NaN if it has none.
glm::dvec2 place_of(const pugi::xml_node& element) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  return {number<double>(element.attribute("lon").value()).value_or(nothing),
          number<double>(element.attribute("lat").value()).value_or(nothing)};
}

void collect_node(const pugi::xml_node& element, OsmCollector& collector) {
  const auto id = number<std::int64_t>(element.attribute("id").value());
  if (id)
    collector.add_node(*id, version_of(element), place_of(element), tags_of(element));
  else
    collector.count_bad_node();
}

void collect_way(const pugi::xml_node& element, OsmCollector& collector) {
  const auto id = number<std::int64_t>(element.attribute("id").value());
  if (!id) return;
  std::vector<OsmNodeRef> nodes;
  for (const pugi::xml_node& reference : element.children("nd"))
    // An unreadable reference counts as a node that the extract lacks.
    nodes.push_back({number<std::int64_t>(reference.attribute("ref").value()).value_or(INT64_MIN),
                     place_of(reference)});
  OsmTags tags = tags_of(element);
  // Overpass' `out center` gives an area one place instead of its nodes': enough for a lamp.
  if (const pugi::xml_node centre = element.child("center"); centre && is_lamp(tags))
    nodes = {{INT64_MIN, place_of(centre)}};
  collector.add_way(*id, version_of(element), std::move(nodes), std::move(tags));
}

std::size_t line_at(const std::filesystem::path& file, std::ptrdiff_t offset) {
  std::ifstream stream(file, std::ios::binary);
  std::string text(static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  return 1 +
         static_cast<std::size_t>(std::count(text.begin(), text.begin() + stream.gcount(), '\n'));
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

void read_osm_xml(const std::filesystem::path& file, OsmCollector& collector) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed =
      document.load_file(file.c_str(), pugi::parse_default | pugi::parse_doctype);
  if (!parsed) throw Error(file.string(), line_at(file, parsed.offset), parsed.description());
  for (const pugi::xml_node& node : document)
    if (node.type() == pugi::node_doctype)
      throw Error(file.string(), "a DOCTYPE has no place in OSM data");
  const pugi::xml_node root = document.child("osm");
  if (!root) throw Error(file.string(), "not OSM XML: the root element is not <osm>");

  for (const pugi::xml_node& element : root) {
    const std::string_view name = element.name();
    if (name == "node") {
      collect_node(element, collector);
    } else if (name == "way") {
      collect_way(element, collector);
    } else if (name == "relation") {
      if (!version_of(element).deleted) collector.add_relation(tags_of(element));
    } else if (name == "remark") {
      take_remark(file, line_at(file, element.offset_debug()), element.text().as_string(),
                  collector);
    }
  }
}

}  // namespace nightcity::osm
