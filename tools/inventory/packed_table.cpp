#include "tools/inventory/packed_table.h"

#include <array>
#include <span>
#include <utility>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "tools/city/packing.h"
#include "tools/cityjson/read_cityjson.h"
#include "tools/inventory/inventory.h"
#include "tools/inventory/memory_folder.h"
#include "tools/osm/read_osm.h"

namespace nightcity::inventory {
namespace {

// The last four are no tables, but belong to a Shapefile.
constexpr std::array<std::string_view, 14> endings{
    ".shp", ".geojson", ".geojsonl", ".json", ".jsonl", ".ndjson", ".csv",
    ".tsv", ".gpkg",    ".fgb",      ".shx",  ".dbf",   ".prj",    ".cpg"};
constexpr std::span table_endings = std::span(endings).first<10>();
constexpr std::string_view unpack = "unpack it and name the file inside";

bool is_table(const city::Document& document) {
  return city::ends_with_any(to_lower(document.name), table_endings);
}

// Returns whether it is a city model or a map in JSON, which other keys of a recipe read.
bool is_other(const city::Document& document) {
  constexpr std::size_t start_bytes = 64 << 10;
  if (!to_lower(document.name).ends_with("json")) return false;
  const std::string start = city::read_start(document, start_bytes);
  return cityjson::begins_as_cityjson(start) || osm::begins_as_osm(start);
}

// Returns a name without what stands behind its last point, in lower case.
std::string find_stem(const std::string& name) {
  return to_lower(name.substr(0, name.rfind('.')));
}

// Returns the name that a stream's content has: without ".gz", and with the ending of what it
// looks like where that leaves none.
std::string find_name_inside(const std::filesystem::path& file, std::string_view bytes) {
  const std::string whole = file.filename().string();
  std::string name(city::without_stream_ending(whole));
  const std::string lower = to_lower(name);
  if (city::ends_with_any(lower, endings)) return name;
  const std::size_t first = bytes.find_first_not_of("\xef\xbb\xbf \t\r\n");
  if (bytes.starts_with("SQLite format 3")) return name + ".gpkg";
  if (bytes.starts_with("fgb")) return name + ".fgb";
  const bool is_json = first != bytes.npos && (bytes[first] == '{' || bytes[first] == '[');
  return name + (is_json ? ".json" : ".csv");
}

std::string list_names(const std::vector<const city::Document*>& documents,
                       const std::string& path) {
  constexpr std::size_t most = 20;
  std::string names;
  for (std::size_t i = 0; i < documents.size() && i < most; ++i)
    names += (i > 0 ? ", " : "") + documents[i]->name.substr(path.size() + 1);
  if (documents.size() > most) names += " and " + std::to_string(documents.size() - most) + " more";
  return names;
}

// Documents of Office and KMZ are archives too.
void refuse_document(const std::filesystem::path& file) {
  const std::string ending = to_lower(file.extension().string());
  for (const char* spreadsheet : {".xlsx", ".xlsm", ".ods"})
    if (ending == spreadsheet)
      throw NoTable(file.string(), "is a spreadsheet: save its table as CSV");
  if (ending == ".kmz")
    throw NoTable(file.string(),
                  "is KML in an archive: save it as GeoJSON, CSV or GeoPackage (ogr2ogr)");
}

std::vector<city::Document> list_documents(const std::filesystem::path& file) {
  refuse_document(file);
  try {
    return city::list_documents(file, endings);
  } catch (const Error& error) {
    throw NoTable("", error.what());
  }
}

}  // namespace

std::string read_whole(const city::Document& document, std::string_view remedy) {
  std::string text = city::read_next(*document.open(), most_whole_bytes + 1);
  if (text.size() > most_whole_bytes)
    throw Error(document.name, "is more than 1 GB: " + std::string(remedy));
  return text;
}

std::vector<MemoryFile> unpack_table(const std::filesystem::path& file) {
  const std::vector<city::Document> documents = list_documents(file);
  if (!documents.front().packed) return {};
  const std::string path = file.string();
  if (documents.front().name == path) {
    std::string bytes = read_whole(documents.front(), unpack);
    std::string name = find_name_inside(file, bytes);
    return {{std::move(name), std::move(bytes)}};
  }
  std::vector<const city::Document*> tables;
  for (const city::Document& document : documents)
    if (is_table(document)) tables.push_back(&document);
  if (tables.empty())
    throw NoTable(path, "the archive holds no table of lamps, but " + documents.front().name +
                            ": " + std::string(unpack));
  if (tables.size() > 1) std::erase_if(tables, [](const auto* table) { return is_other(*table); });
  if (tables.empty())
    throw NoTable(path, "the archive holds no table of lamps, but city models or maps in JSON");
  if (tables.size() > 1)
    throw Error(path, "the archive holds several tables (" + list_names(tables, path) +
                          "): unpack it and name one of them, or a row of [[lamps.inventories]] "
                          "for each");
  const city::Document& table = *tables.front();
  std::vector<MemoryFile> files{{table.name, read_whole(table, unpack)}};
  if (!to_lower(table.name).ends_with(".shp")) return files;
  // GDAL looks for the others by the Shapefile's name, and case counts in its memory.
  const std::string stem = table.name.substr(0, table.name.rfind('.'));
  files.front().name = stem + ".shp";
  for (const city::Document& document : documents)
    if (&document != &table && find_stem(document.name) == find_stem(table.name))
      files.push_back({stem + to_lower(document.name.substr(document.name.rfind('.'))),
                       read_whole(document, unpack)});
  return files;
}

}  // namespace nightcity::inventory
