// What kind of OSM file it is, decided by its first bytes: names lie.
#include <array>
#include <fstream>
#include <string_view>

#include "formats/error.h"
#include "tools/osm/osm_data.h"
#include "tools/osm/osm_parsers.h"

namespace nightcity {

OsmData read_osm(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw Error(file.string(), "no such file");
  if (!std::filesystem::is_regular_file(file, error)) throw Error(file.string(), "not a file");
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 64> bytes{};
  stream.read(bytes.data(), bytes.size());
  std::string_view head(bytes.data(), static_cast<std::size_t>(stream.gcount()));
  if (head.empty())
    throw Error(file.string(), stream.bad() || !stream.eof() ? "cannot read" : "the file is empty");

  if (head.starts_with("\x1f\x8b")) return read_osm_packed(file, "osm.gz");
  if (head.starts_with("BZh")) return read_osm_packed(file, "osm.bz2");
  if (head.starts_with("\xff\xe0")) return read_osm_packed(file, "o5m");
  // A PBF begins with the length of a blob header whose first field is the text "OSMHeader".
  if (head.size() > 16 && head.substr(4, 11) == "\x0a\x09OSMHeader")
    return read_osm_packed(file, "pbf");
  if (head.starts_with("\xef\xbb\xbf")) head.remove_prefix(3);
  const std::size_t text = head.find_first_not_of(" \t\r\n");
  if (text != std::string_view::npos && head[text] == '<') return read_osm_xml(file);
  throw Error(file.string(), "not OSM data: neither XML, PBF, gzip nor bzip2");
}

}  // namespace nightcity
