#include "tools/inventory/vector_file.h"

#include <cpl_error.h>
#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "formats/error.h"
#include "formats/input_file.h"
#include "formats/mapped_file.h"
#include "formats/to_lower.h"
#include "tools/city/foreign_format.h"
#include "tools/city/text_encoding.h"
#include "tools/gdal/guarded_gdal.h"
#include "tools/inventory/coordinate_columns.h"
#include "tools/inventory/csv_encoding.h"
#include "tools/inventory/csv_head.h"
#include "tools/inventory/geojson_crs.h"
#include "tools/inventory/json_table.h"
#include "tools/inventory/loose_json.h"
#include "tools/inventory/packed_table.h"
#include "tools/inventory/table_text.h"
#include "tools/inventory/text_places.h"
#include "tools/osm/osm_json.h"

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
}

// Returns the first bytes of a file that GDAL can open.
std::string read_start(const std::string& path) {
  std::string start(8192, '\0');
  VSILFILE* const file = VSIFOpenL(path.c_str(), "rb");
  if (!file) return {};
  start.resize(VSIFReadL(start.data(), 1, start.size(), file));
  VSIFCloseL(file);
  return start;
}

// Returns what GDAL said or, where it said nothing, what the file looks like. `json`: why it is no
// table in JSON.
std::string explain_unread(const std::string& path, const std::string& said,
                           const std::string& json) {
  if (said.find(".shx") != std::string::npos)
    return "the file " + std::filesystem::path(path).stem().string() +
           ".shx that belongs to it is missing";
  const std::string start = read_start(path);
  const std::string what = city::name_foreign(start, "");
  const std::string remedy = "; a table can be saved as GeoJSON, CSV or GeoPackage (ogr2ogr)";
  if (!json.empty())
    return what.empty() ? json + remedy : "it " + what + " (" + json + ")" + remedy;
  if (!said.empty()) return said;
  if (start.empty()) return "it is empty";
  if (!what.empty()) return "it " + what + remedy;
  if (start.substr(0, 4).find('\0') != start.npos)
    return "it is no text in UTF-8: save it so, or in UTF-16 with a mark of byte order";
  return "its content is none of these; a CSV has the ending .csv, .tsv or .txt, and commas, "
         "semicolons, tabs or bars between its columns";
}

bool is_named_as_csv(const std::string& path) {
  const std::string name = to_lower(path);
  return name.ends_with(".csv") || name.ends_with(".tsv");
}

// Puts a CSV into a form that GDAL reads.
void prepare_csv(const InventoryFile& inventory, std::string& bytes, VectorFile& out) {
  constexpr std::size_t enough = 65536;  // for the headings
  out.encoding = find_csv_encoding(std::string_view(bytes).substr(0, enough), inventory);
  if (!out.encoding.empty()) bytes = decode_csv(bytes, out.encoding, inventory.file.string());
  const CsvHead head = find_csv_head(std::string_view(bytes).substr(0, enough), inventory);
  out.titles = head.above;
  if (head.above > 0) bytes.erase(0, head.begin);
  straighten_csv(bytes);
}

// Returns the file beside a CSV that defines its CRS; an empty path without.
std::filesystem::path find_prj_beside(const std::filesystem::path& csv) {
  std::filesystem::path beside = csv;
  std::error_code ignored;
  for (const char* ending : {".prj", ".PRJ", ".Prj"})
    if (std::filesystem::is_regular_file(beside.replace_extension(ending), ignored)) return beside;
  return {};
}

// Puts a table that GDAL would not read as it lies on the disk into memory, and sets the path to
// it.
void put_into_memory(const InventoryFile& inventory, VectorFile& out) {
  const std::filesystem::path& file = inventory.file;
  // The whole path, which no prefix of GDAL's own file systems can be.
  out.path = std::filesystem::absolute(file).string();
  out.stem = file.stem().string();
  std::string start = read_start(out.path);
  if (start.empty()) return;
  std::vector<MemoryFile> files = unpack_table(file);
  if (files.empty()) {
    const bool is_wide = city::begins_as_utf16(start) || city::begins_as_utf32(start);
    const bool is_csv = is_named_as_csv(out.path), is_text = to_lower(out.path).ends_with(".txt");
    const auto has_odd_head = [&] {
      return find_csv_head(start, inventory).above > 0 ||
             !find_csv_encoding(start, inventory).empty();
    };
    const auto has_odd_rows = [&] {
      const MappedFile whole(file);
      return has_stray_marks({reinterpret_cast<const char*>(whole.bytes().data()),  // chars alias
                              whole.bytes().size()});
    };
    constexpr std::size_t most_prj_bytes = 65536;
    const std::filesystem::path prj = is_csv ? find_prj_beside(file) : std::filesystem::path();
    const bool has_odd_prj = !prj.empty() && prj.extension() != ".prj";  // GDAL looks for no other
    if (!is_wide && !is_text &&
        !(is_csv && (is_odd_csv(start) || has_odd_head() || has_odd_rows() || has_odd_prj)))
      return;
    const std::array<std::string_view, 1> endings{""};
    files.push_back(
        {is_text ? file.stem().string() + ".csv" : file.filename().string(),
         read_whole(city::list_documents(file, endings).front(),
                    "save it in UTF-8, with commas and its headings in the first line")});
    if (!prj.empty())
      files.push_back(
          {file.stem().string() + ".prj",
           read_start(std::filesystem::absolute(prj).string()).substr(0, most_prj_bytes)});
  }
  out.stem = std::filesystem::path(files.front().name).stem().string();
  if (is_named_as_csv(files.front().name)) prepare_csv(inventory, files.front().bytes, out);
  for (std::size_t i = files.size(); i-- > 0;) {
    out.path = out.memory.add(files[i].name, files[i].bytes);
    files.pop_back();
  }
}

GDALDatasetUniquePtr open_dataset(const std::string& path, const CPLStringList& options) {
  return GDALDatasetUniquePtr(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY,
                                                drivers.data(), options.List(), nullptr));
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
  const GDALDatasetUniquePtr dataset = open_dataset(path, {});
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

// Returns whether a text begins with a mark of UTF-8 and an object of JSON: of one object a line
// GDAL would read the first line alone.
bool is_marked_json(std::string_view start) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  if (!start.starts_with(mark)) return false;
  start.remove_prefix(mark.size());
  const std::size_t first = start.find_first_not_of(" \t\r\n\x1e");
  return first != start.npos && start[first] == '{';
}

// Returns whether GDAL took a text for GeoJSON and found nothing, as in rows whose form is similar.
bool is_empty_json(const VectorFile& table) {
  if (table.format.find("JSON") == std::string::npos) return false;
  if (table.dataset->GetLayerCount() != 1) return table.dataset->GetLayerCount() == 0;
  OGRLayer& layer = *table.dataset->GetLayer(0);
  layer.ResetReading();
  const bool is_empty = OGRFeatureUniquePtr(layer.GetNextFeature()) == nullptr;
  layer.ResetReading();
  return is_empty;
}

// Returns all of a text that GDAL can open.
std::string read_json(const std::string& path, const std::filesystem::path& file) {
  VSIStatBufL status;
  if (VSIStatL(path.c_str(), &status) != 0) return {};
  const auto size = static_cast<vsi_l_offset>(status.st_size);
  if (size > most_whole_bytes)
    throw Error(file.string(), "is JSON but no GeoJSON, of more than 1 GB: save it as CSV");
  std::string text(size, '\0');
  VSILFILE* const stream = VSIFOpenL(path.c_str(), "rb");
  if (!stream) return {};
  text.resize(VSIFReadL(text.data(), 1, text.size(), stream));
  VSIFCloseL(stream);
  return text;
}

// Opens rows in JSON that GDAL does not know. Returns why they are none; "" where they are.
std::string open_json(const InventoryFile& inventory, VectorFile& out) {
  std::string why;
  JsonTable table =
      read_json_table(read_json(out.path, inventory.file), inventory.file.string(), why);
  if (!why.empty()) return why;
  out.dataset.reset();
  if (table.csv.empty()) throw Error(inventory.file.string(), "has no row");
  out.path = out.memory.add(inventory.file.stem().string() + ".csv", table.csv);
  out.dataset = open_dataset(out.path, find_columns_of_places(out.path, inventory));
  out.format = "JSON";
  out.crs = table.crs;
  out.incomplete = table.incomplete;
  return out.dataset ? "" : "its rows make no table";
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

VectorFile open_vector_file(const InventoryFile& inventory) {
  refuse_what_is_no_table(inventory.file);
  gdal::register_drivers();
  const gdal::Guard guard;
  // One object of GeoJSON may take so many MB: a lamp needs a kilobyte.
  CPLSetThreadLocalConfigOption("OGR_GEOJSON_MAX_OBJ_SIZE", "16");
  VectorFile out;
  put_into_memory(inventory, out);
  CPLStringList options;
  if (is_named_as_csv(out.path)) options = find_columns_of_places(out.path, inventory);
  const std::string start = read_start(out.path);
  CPLErrorReset();
  out.dataset = open_dataset((is_marked_json(start) ? "/vsisubfile/3," : "") + out.path, options);
  const std::string said = CPLGetLastErrorMsg();
  if (out.dataset) out.format = out.dataset->GetDriver()->GetDescription();
  if (out.format == "GeoJSON") out.crs = find_odd_crs(out.path);
  if (out.dataset && !is_empty_json(out)) return out;
  if (osm::begins_as_osm_json(start))
    throw NoTable(inventory.file.string(), "is a map (OSM) in JSON: name it in [osm] files");
  std::string why;
  if (begins_as_loose_json(start)) why = open_json(inventory, out);
  if (out.dataset) return out;
  throw NoTable(inventory.file.string(),
                "is no table of lamps that can be read (GeoJSON, CSV, GeoPackage, Shapefile, "
                "FlatGeobuf, rows in JSON): " +
                    explain_unread(out.path, said, why));
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
  if (layer.GetGeomType() != wkbNone) return -1;
  OGRFeatureDefn& columns = *layer.GetLayerDefn();
  for (int i = 0; i < columns.GetFieldCount(); ++i)
    if (is_name_of_points(columns.GetFieldDefn(i)->GetNameRef())) return i;
  return -1;
}

}  // namespace nightcity::inventory
