#include "tools/osm/osm_document.h"

#include <osmium/io/any_compression.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <string_view>

#include "formats/error.h"
#include "tools/osm/osm_marks.h"

namespace nightcity::osm {
namespace {

constexpr unsigned parse_flags = pugi::parse_default | pugi::parse_doctype;

std::size_t count_lines(std::string_view text) {
  return 1 + static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

void require_map(const pugi::xml_document& document, const std::filesystem::path& file) {
  for (const pugi::xml_node& node : document)
    if (node.type() == pugi::node_doctype)
      throw Error(file.string(), "a DOCTYPE has no place in OSM data");
  const auto is_element = [](const pugi::xml_node& node) {
    return node.type() == pugi::node_element;
  };
  if (std::count_if(document.begin(), document.end(), is_element) > 1)
    throw Error(file.string(),
                "holds several documents one after the other, of which only the first would be "
                "read: name each file by itself, or merge them (osmium merge)");
  if (!document.child("osm"))
    throw Error(file.string(), "not OSM XML: the root element is not <osm>");
}

}  // namespace

std::size_t line_at(const std::filesystem::path& file, std::ptrdiff_t offset) {
  std::ifstream stream(file, std::ios::binary);
  std::string text(static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  return count_lines(std::string_view(text).substr(0, static_cast<std::size_t>(stream.gcount())));
}

pugi::xml_document load_osm_document(const std::filesystem::path& file) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_file(file.c_str(), parse_flags);
  if (!parsed) throw Error(file.string(), line_at(file, parsed.offset), parsed.description());
  require_map(document, file);
  return document;
}

pugi::xml_document parse_osm_document(const std::string& text, const std::filesystem::path& file) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size(), parse_flags);
  if (!parsed) throw Error(file.string(), std::string("broken XML: ") + parsed.description());
  require_map(document, file);
  return document;
}

std::optional<std::string> unpack_answer(const std::filesystem::path& file) {
  // Maps shrink to a tenth or twentieth. A file made to unpack to much more is read in a stream.
  constexpr std::uintmax_t least_bytes = 16 << 20, most_bytes = std::uintmax_t{1} << 30, ratio = 50;
  constexpr std::size_t root_bytes = 4096;
  std::error_code ignored;
  const std::uintmax_t packed = std::filesystem::file_size(file, ignored);
  const std::uintmax_t max_bytes =
      std::clamp(ratio * std::min(packed, most_bytes), least_bytes, most_bytes);
  std::array<char, 4> mark{};
  std::ifstream(file, std::ios::binary).read(mark.data(), mark.size());
  const std::string_view start(mark.data(), mark.size());
  const bool is_gzip = start.starts_with("\x1f\x8b");
  if (!is_gzip && !is_bzip2(start)) return std::nullopt;
  try {
    const int descriptor = osmium::io::detail::open_for_reading(file.string());
    const auto source = osmium::io::CompressionFactory::instance().create_decompressor(
        is_gzip ? osmium::io::file_compression::gzip : osmium::io::file_compression::bzip2,
        descriptor);
    std::string text = source->read();
    const std::string_view root = std::string_view(text).substr(0, root_bytes);
    const bool is_answer = root.find("Overpass") != root.npos || root.find("JOSM") != root.npos;
    for (std::string block; is_answer && text.size() <= max_bytes; text += block)
      if ((block = source->read()).empty()) break;
    source->close();
    if (!is_answer || text.size() > max_bytes) return std::nullopt;
    return text;
  } catch (const std::exception& error) {
    throw Error(file.string(),
                std::string("broken osm.") + (is_gzip ? "gz: " : "bz2: ") + error.what());
  }
}

std::optional<pugi::xml_document> find_osm_document(const std::filesystem::path& file) {
  std::array<char, 64> bytes{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), bytes.size());
  if (is_xml({bytes.data(), static_cast<std::size_t>(stream.gcount())}))
    return load_osm_document(file);
  if (const std::optional<std::string> text = unpack_answer(file))
    return parse_osm_document(*text, file);
  return std::nullopt;
}

OsmTags read_tags(const pugi::xml_node& element) {
  OsmTags tags;
  for (const pugi::xml_node& tag : element.children("tag"))
    tags.emplace(tag.attribute("k").value(), tag.attribute("v").value());
  return tags;
}

OsmVersion read_version(const pugi::xml_node& element) {
  const std::string_view action = element.attribute("action").value();
  return {to_number<std::uint32_t>(element.attribute("version").value()).value_or(0),
          !action.empty(),
          action == "delete" || std::string_view(element.attribute("visible").value()) == "false"};
}

glm::dvec2 read_place(const pugi::xml_node& element) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  return {to_number<double>(element.attribute("lon").value()).value_or(nothing),
          to_number<double>(element.attribute("lat").value()).value_or(nothing)};
}

}  // namespace nightcity::osm
