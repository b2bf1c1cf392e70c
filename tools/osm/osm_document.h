// OSM XML as a document, and the values of its elements.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <pugixml.hpp>
#include <string>

#include "tools/osm/osm_collector.h"

namespace nightcity::osm {

/// Reads plain OSM XML in UTF-8 or UTF-16. Throws Error: missing, broken XML (with its line), a
/// DOCTYPE, or another root than <osm>.
pugi::xml_document load_osm_document(const std::filesystem::path& file);
/// The same for a text that was unpacked from `file`.
pugi::xml_document parse_osm_document(const std::string& text, const std::filesystem::path& file);

/// Returns the text of a map packed by gzip or bzip2 that Overpass answered or JOSM wrote; none for
/// every other file, and for one that unpacks to more than 1 GB, or 16 MB and 50 times its size.
/// These come in any order and hold places where libosmium allows none, so they have to be read
/// whole. Throws Error where the packing is
/// broken.
std::optional<std::string> unpack_answer(const std::filesystem::path& file);

/// Returns the document of a map in plain XML, or in Overpass' packed; none for other files. Throws
/// Error as the functions above do.
std::optional<pugi::xml_document> find_osm_document(const std::filesystem::path& file);

/// Returns the number of the line in a plain file in which a byte stands.
std::size_t line_at(const std::filesystem::path& file, std::ptrdiff_t offset);

/// Returns the whole text as a number, or none: "52.5x" and "" are no coordinates.
template <class Number>
std::optional<Number> to_number(const char* text) {
  Number value{};
  const char* end = text + std::strlen(text);
  const auto [stop, error] = std::from_chars(text, end, value);
  if (error != std::errc() || stop != end || text == end) return std::nullopt;
  return value;
}

OsmTags read_tags(const pugi::xml_node& element);
/// Editors keep what a user has deleted until it is uploaded.
OsmVersion read_version(const pugi::xml_node& element);
/// Returns the place of a node, or of a way's reference to a node; NaN if it has none.
glm::dvec2 read_place(const pugi::xml_node& element);

}  // namespace nightcity::osm
