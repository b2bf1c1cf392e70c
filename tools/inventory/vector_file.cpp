#include "tools/inventory/vector_file.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "formats/error.h"
#include "formats/input_file.h"
#include "formats/to_lower.h"
#include "tools/city/byte_source.h"
#include "tools/city/foreign_format.h"
#include "tools/city/text_encoding.h"
#include "tools/gdal/guarded_gdal.h"
#include "tools/inventory/text_places.h"

namespace nightcity::inventory {
namespace {

constexpr std::array drivers{
    "GeoJSON", "GeoJSONSeq",     "ESRIJSON",   "CSV",
    "GPKG",    "ESRI Shapefile", "FlatGeobuf", static_cast<const char*>(nullptr)};

void refuse_what_is_no_table(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw Error(file.string(), "is not there");
  if (std::filesystem::is_directory(file, error))
    throw Error(file.string(), "is a folder: name the file in it");
  refuse_special_file(file);
  const std::string name = to_lower(file.filename().string());
  for (const char* ending : {".zip", ".gz", ".shz", ".7z"})
    if (name.ends_with(ending))
      throw Error(file.string(), "is packed: unpack it first and name the file inside");
}

// Returns what GDAL said or, where it said nothing, what the file looks like.
std::string explain_unread(const std::filesystem::path& file) {
  const std::string said = CPLGetLastErrorMsg();
  if (said.find(".shx") != std::string::npos)
    return "the file " + file.stem().string() + ".shx that belongs to it is missing";
  if (!said.empty()) return said;
  std::array<char, 4096> bytes{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), bytes.size());
  const std::string_view start(bytes.data(), static_cast<std::size_t>(stream.gcount()));
  if (city::begins_as_utf16(start)) return "it is text in UTF-16: save it in UTF-8";
  if (start.starts_with("PK\x03\x04"))
    return "it is an archive or a spreadsheet: unpack it, or save the table as CSV";
  if (start.empty()) return "it is empty";
  if (const std::size_t first = start.find_first_not_of(" \t\r\n");
      first < start.size() && start[first] == '[')
    return "it is a list in JSON: a table is one object, a FeatureCollection, or an object a line "
           "(jq -c '.[]' makes lines of a list)";
  if (start.substr(0, 4).find('\0') != start.npos)
    return "it is no text in UTF-8: save it so, or in UTF-16 with a mark of byte order";
  if (const std::string what = city::name_foreign(start, ""); !what.empty())
    return "it " + what + "; a table can be saved as GeoJSON, CSV or GeoPackage (ogr2ogr)";
  return "its content is none of these; a CSV has the ending .csv or .tsv, and commas, semicolons, "
         "tabs or bars between its columns";
}

// A file in memory under a name of its own. GDAL keeps one that is open when its name is removed.
class TranslatedFile {
 public:
  TranslatedFile(std::string text, const std::string& ending) : text_(std::move(text)) {
    static std::atomic<unsigned> count{0};
    path_ = "/vsimem/nightcity_table_" + std::to_string(++count) + ending;
    auto* bytes = static_cast<GByte*>(CPLMalloc(text_.size() + 1));
    std::copy(text_.begin(), text_.end(), bytes);
    VSILFILE* file = VSIFileFromMemBuffer(path_.c_str(), bytes, text_.size(), TRUE);
    if (file) VSIFCloseL(file);
    text_ = {};
  }
  ~TranslatedFile() { VSIUnlink(path_.c_str()); }
  TranslatedFile(const TranslatedFile&) = delete;
  TranslatedFile& operator=(const TranslatedFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string text_, path_;
};

// Returns whether a table begins with the line that tells Excel which sign separates its columns.
bool begins_with_separator(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return to_lower(text.substr(0, 4)) == "sep=";
}

// Returns whether bars separate the columns of a table, which GDAL takes for text: its first line
// has no other separator.
bool has_bars(std::string_view text) {
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  return line.find('|') != line.npos && line.find_first_of(",;\t") == line.npos;
}

// Returns whether a table begins with lines of nothing, in which GDAL finds no column.
bool begins_with_blank_line(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t");
  return first != text.npos && (text[first] == '\r' || text[first] == '\n');
}

// Makes tabs of bars but for those in quotation marks.
void replace_bars(std::string& text) {
  bool quoted = false;
  for (char& c : text) {
    if (c == '"') quoted = !quoted;
    if (c == '|' && !quoted) c = '\t';
  }
}

// Returns a table in UTF-16 or UTF-32, as spreadsheets save "Unicode text", in UTF-8, one that
// begins with "sep=;" or blank lines without these, and one with bars between its columns with
// tabs; null for others.
std::unique_ptr<TranslatedFile> translate_text(const std::filesystem::path& file,
                                               const std::string& ending) {
  std::array<char, 8192> bytes{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), bytes.size());
  const std::string_view start(bytes.data(), static_cast<std::size_t>(stream.gcount()));
  if (!city::begins_as_utf16(start) && !city::begins_as_utf32(start) &&
      !begins_with_separator(start) && !has_bars(start) && !begins_with_blank_line(start))
    return nullptr;
  constexpr std::size_t most = std::size_t{1} << 30;
  const std::array<std::string_view, 1> endings{ending};
  const auto source = city::list_documents(file, endings).front().open();
  std::string text;
  for (std::size_t end = 0, size = 0;; end += size) {
    text.resize(end + (std::size_t{1} << 16));
    size = source->read(text.data() + end, text.size() - end);
    if (size == 0) {
      text.resize(end);
      break;
    }
    if (end + size > most)
      throw Error(file.string(),
                  "is text in UTF-16, with bars, blank lines at its beginning or a line \"sep=\", "
                  "of more than 1 GB: "
                  "save it in UTF-8 with commas and without these lines");
  }
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  if (begins_with_separator(text)) text.erase(0, text.find_first_of("\r\n"));
  while (begins_with_blank_line(text)) text.erase(0, text.find_first_of("\r\n") + 1);
  if (has_bars(text)) replace_bars(text);
  return std::make_unique<TranslatedFile>(std::move(text), ending);
}

// Returns a column's name as GDAL's options take it, which end a name at a comma.
std::string to_pattern(OGRFeatureDefn& columns, int column) {
  const std::string name = columns.GetFieldDefn(column)->GetNameRef();
  const std::size_t comma = name.find(',');
  return comma == name.npos ? name : name.substr(0, comma) + "*";
}

// Tells GDAL which columns of a CSV hold its places. Where the first rows have degrees and minutes
// there, or digits in groups, it does not: it would make numbers of them and lose what is none.
CPLStringList find_columns_of_places(const std::string& path, const InventoryFile& inventory) {
  CPLStringList options;
  const GDALDatasetUniquePtr dataset(GDALDataset::Open(
      path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, drivers.data(), nullptr, nullptr));
  if (!dataset || dataset->GetLayerCount() == 0) return options;
  OGRFeatureDefn& columns = *dataset->GetLayer(0)->GetLayerDefn();
  const TextPlaces places(*dataset->GetLayer(0), inventory);
  if (places.has_columns() && !places.begins_with_angles() && !places.begins_with_groups()) {
    options.SetNameValue("X_POSSIBLE_NAMES", to_pattern(columns, places.x()).c_str());
    options.SetNameValue("Y_POSSIBLE_NAMES", to_pattern(columns, places.y()).c_str());
  }
  if (inventory.x.empty() && places.geometry() >= 0)
    options.SetNameValue("GEOM_POSSIBLE_NAMES", to_pattern(columns, places.geometry()).c_str());
  return options;
}

// Returns whether a file begins with a mark of UTF-8 and an object of JSON: of one object a line
// GDAL would read the first line alone.
bool is_marked_json(const std::filesystem::path& file) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  std::array<char, 64> bytes{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), bytes.size());
  std::string_view start(bytes.data(), static_cast<std::size_t>(stream.gcount()));
  if (!start.starts_with(mark)) return false;
  start.remove_prefix(mark.size());
  const std::size_t first = start.find_first_not_of(" \t\r\n\x1e");
  return first != start.npos && start[first] == '{';
}

// Returns whether lamps may lie in a layer: GeoPackages hold tables of styles and attributes too.
bool may_hold_points(OGRLayer& layer) {
  const OGRwkbGeometryType type = wkbFlatten(layer.GetGeomType());
  return type == wkbPoint || type == wkbMultiPoint || type == wkbUnknown ||
         type == wkbGeometryCollection;
}

std::string list_layers(GDALDataset& dataset) {
  std::string names;
  for (int i = 0; i < dataset.GetLayerCount(); ++i)
    names += std::string(i > 0 ? ", \"" : "\"") + dataset.GetLayer(i)->GetName() + "\"";
  return names;
}

}  // namespace

GDALDatasetUniquePtr open_vector_file(const InventoryFile& inventory) {
  refuse_what_is_no_table(inventory.file);
  gdal::register_drivers();
  const gdal::Guard guard;
  // One object of GeoJSON may take so many MB: a lamp needs a kilobyte.
  CPLSetThreadLocalConfigOption("OGR_GEOJSON_MAX_OBJ_SIZE", "16");
  // The whole path, which no prefix of GDAL's own file systems can be.
  std::string path = std::filesystem::absolute(inventory.file).string();
  CPLStringList options;
  std::unique_ptr<TranslatedFile> translated;
  if (const std::string ending = to_lower(inventory.file.extension().string());
      ending == ".csv" || ending == ".tsv") {
    translated = translate_text(inventory.file, ending);
    if (translated) path = translated->path();
    options = find_columns_of_places(path, inventory);
  } else if (is_marked_json(inventory.file)) {
    path = "/vsisubfile/3," + path;
  }
  GDALDatasetUniquePtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY,
                                                 drivers.data(), options.List(), nullptr));
  if (!dataset)
    throw NoTable(inventory.file.string(),
                  "is no table of lamps that can be read (GeoJSON, CSV, GeoPackage, Shapefile, "
                  "FlatGeobuf): " +
                      explain_unread(inventory.file));
  return dataset;
}

OGRLayer& find_layer(GDALDataset& dataset, const InventoryFile& inventory) {
  const std::string file = inventory.file.string();
  if (!inventory.layer.empty()) {
    if (OGRLayer* layer = dataset.GetLayerByName(inventory.layer.c_str())) return *layer;
    throw Error(file, "has no layer \"" + inventory.layer + "\": it has " + list_layers(dataset));
  }
  if (dataset.GetLayerCount() == 1) return *dataset.GetLayer(0);
  if (dataset.GetLayerCount() == 0) throw Error(file, "has no layer: it is empty or cut short");
  OGRLayer* only = nullptr;
  int possible = 0;
  for (int i = 0; i < dataset.GetLayerCount(); ++i)
    if (may_hold_points(*dataset.GetLayer(i))) only = dataset.GetLayer(i), ++possible;
  if (possible == 1) return *only;
  throw Error(file, "has several layers (" + list_layers(dataset) +
                        "): name one by layer in [[lamps.inventories]]");
}

int find_point_column(OGRLayer& layer) {
  // OpenDataSoft's, Socrata's and ArcGIS Hub's, without blanks and underscores.
  constexpr std::array<std::string_view, 6> names{"geopoint2d", "geopoint",    "latlon",
                                                  "latlong",    "coordinates", "location"};
  if (layer.GetGeomType() != wkbNone) return -1;
  OGRFeatureDefn& columns = *layer.GetLayerDefn();
  for (int i = 0; i < columns.GetFieldCount(); ++i) {
    std::string name = to_lower(columns.GetFieldDefn(i)->GetNameRef());
    std::erase_if(name, [](char c) { return c == ' ' || c == '_'; });
    if (std::find(names.begin(), names.end(), name) != names.end()) return i;
  }
  return -1;
}

const char* driver_name(GDALDataset& dataset) {
  return dataset.GetDriver() ? dataset.GetDriver()->GetDescription() : "";
}

}  // namespace nightcity::inventory
