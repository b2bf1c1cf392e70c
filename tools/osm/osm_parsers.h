// The two parsers behind read_osm.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <pugixml.hpp>
#include <string>

#include "tools/osm/osm_collector.h"

namespace nightcity::osm {

/// Reads plain OSM XML by pugixml. Throws Error: broken XML (with its line), a DOCTYPE, another
/// root than <osm>, or a remark of the server that the answer is incomplete.
void read_osm_xml(const std::filesystem::path& file, OsmCollector& collector);

/// Returns the line at an offset of a document; 0 = not known.
using LineFinder = std::function<std::size_t(std::ptrdiff_t)>;

/// The same for a document: `root` is its root element. `file` is named in errors.
void collect_document(const pugi::xml_node& root, const std::filesystem::path& file,
                      const LineFinder& find_line, OsmCollector& collector);

/// Reads by libosmium, but for Overpass' answers packed by gzip or bzip2. `format`: its name for it, "pbf", "osm.gz", "osm.bz2" or "o5m". Throws
/// Error.
void read_osm_packed(const std::filesystem::path& file, const std::string& format,
                     OsmCollector& collector);

/// Keeps a remark of the server. Throws Error where it says that the answer is incomplete; Overpass
/// puts its errors at the end of an answer that looks sound. `line`: 0 = not known.
void take_remark(const std::filesystem::path& file, std::size_t line, const std::string& text,
                 OsmCollector& collector);

}  // namespace nightcity::osm
