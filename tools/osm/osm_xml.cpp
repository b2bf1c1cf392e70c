#include <algorithm>
#include <charconv>
#include <cstring>
#include <fstream>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "formats/error.h"
#include "tools/osm/osm_collector.h"
#include "tools/osm/osm_parsers.h"

namespace nightcity {
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
bool deleted(const pugi::xml_node& element) {
  return std::string_view(element.attribute("action").value()) == "delete" ||
         std::string_view(element.attribute("visible").value()) == "false";
}

std::size_t line_at(const std::filesystem::path& file, std::ptrdiff_t offset) {
  std::ifstream stream(file, std::ios::binary);
  std::string text(static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  return 1 +
         static_cast<std::size_t>(std::count(text.begin(), text.begin() + stream.gcount(), '\n'));
}

}  // namespace

OsmData read_osm_xml(const std::filesystem::path& file) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed =
      document.load_file(file.c_str(), pugi::parse_default | pugi::parse_doctype);
  if (!parsed) throw Error(file.string(), line_at(file, parsed.offset), parsed.description());
  for (const pugi::xml_node& node : document)
    if (node.type() == pugi::node_doctype)
      throw Error(file.string(), "a DOCTYPE has no place in OSM data");
  const pugi::xml_node root = document.child("osm");
  if (!root) throw Error(file.string(), "not OSM XML: the root element is not <osm>");

  OsmCollector collector;
  for (const pugi::xml_node& element : root) {
    const std::string_view name = element.name();
    if (deleted(element)) continue;
    const auto id = number<std::int64_t>(element.attribute("id").value());
    if (name == "node") {
      const auto lon = number<double>(element.attribute("lon").value());
      const auto lat = number<double>(element.attribute("lat").value());
      if (id && lon && lat)
        collector.add_node(*id, {*lon, *lat}, tags_of(element));
      else
        collector.count_bad_node();
    } else if (name == "way") {
      std::vector<std::int64_t> nodes;
      for (const pugi::xml_node& reference : element.children("nd"))
        // An unreadable reference counts as a node that the extract lacks.
        nodes.push_back(
            number<std::int64_t>(reference.attribute("ref").value()).value_or(INT64_MIN));
      if (id) collector.add_way(*id, std::move(nodes), tags_of(element));
    } else if (name == "relation") {
      collector.count_relation();
    }
  }
  return std::move(collector).finish();
}

}  // namespace nightcity
