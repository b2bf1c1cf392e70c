#include "tools/osm/read_osm.h"

#include <array>
#include <fstream>
#include <string>
#include <utility>

#include "formats/error.h"
#include "tools/osm/map_file.h"
#include "tools/osm/osm_json.h"
#include "tools/osm/osm_marks.h"
#include "tools/osm/osm_parsers.h"

namespace nightcity::osm {
namespace {

constexpr std::size_t mark_bytes = 1024;

std::string read_mark(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw Error(file.string(), "no such file");
  if (std::filesystem::is_directory(file, error))
    throw Error(file.string(), "is a folder, not a file: name the maps in it");
  if (!std::filesystem::is_regular_file(file, error)) throw Error(file.string(), "not a file");
  std::ifstream stream(file, std::ios::binary);
  std::array<char, mark_bytes> bytes{};
  stream.read(bytes.data(), bytes.size());
  if (stream.gcount() == 0)
    throw Error(file.string(), stream.bad() || !stream.eof() ? "cannot read" : "the file is empty");
  return {bytes.data(), static_cast<std::size_t>(stream.gcount())};
}

void collect(const std::filesystem::path& file, OsmCollector& collector) {
  const std::string mark = read_mark(file);
  std::string_view start(mark);
  collector.begin_file();
  if (const std::string what = describe_unread_osm(start); !what.empty())
    throw Error(file.string(), what);
  if (start.starts_with("\x1f\x8b")) return read_osm_packed(file, "osm.gz", collector);
  if (is_bzip2(start)) return read_osm_packed(file, "osm.bz2", collector);
  if (is_o5m(start)) return read_osm_packed(file, "o5m", collector);
  if (is_osm_pbf(start)) return read_osm_packed(file, "pbf", collector);
  if (is_xml(start)) return read_osm_xml(file, collector);
  throw Error(file.string(), "not OSM data: neither XML, PBF, o5m, gzip nor bzip2");
}

}  // namespace

bool begins_as_osm(std::string_view start) {
  const auto holds = [start](std::string_view text) {
    return start.find(text) != std::string_view::npos;
  };
  return is_osm_pbf(start) || is_o5m(start) || holds("<osm ") || holds("<osm>") ||
         begins_as_osm_json(start);
}

OsmData read_osm(std::span<const std::filesystem::path> files, std::size_t max_way_nodes) {
  OsmCollector collector(max_way_nodes);
  const auto collect_all = [&] {
    for (const std::filesystem::path& file : files)
      read_map_file(file, [&](const std::filesystem::path& plain) { collect(plain, collector); });
  };
  collect_all();
  if (collector.begin_members()) collect_all();
  return std::move(collector).finish();
}

OsmData read_osm(const std::filesystem::path& file, std::size_t max_way_nodes) {
  return read_osm(std::span(&file, 1), max_way_nodes);
}

}  // namespace nightcity::osm
