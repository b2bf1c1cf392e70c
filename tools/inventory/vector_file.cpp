#include "tools/inventory/vector_file.h"

#include <cpl_conv.h>
#include <cpl_error.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "formats/error.h"
#include "formats/input_file.h"
#include "formats/packed_file.h"
#include "formats/to_lower.h"
#include "tools/gdal/guarded_gdal.h"

namespace nightcity::inventory {
namespace {

constexpr std::array drivers{
    "GeoJSON", "GeoJSONSeq",     "ESRIJSON",   "CSV",
    "GPKG",    "ESRI Shapefile", "FlatGeobuf", static_cast<const char*>(nullptr)};

// Names of columns with coordinates that open portals use.
constexpr const char* x_names =
    "lon,long,lng,longitude,x,x_coord,xcoord,coord_x,point_x,easting,laengengrad,längengrad,"
    "geo_laenge,rechtswert,ostwert,longitud,longitudine,lengtegraad,x_wgs84,utm_x,utm_e,"
    "lon (*,long (*,longitude (*,x (*,easting (*,lon [*,longitude [*,x [*,easting [*";
constexpr const char* y_names =
    "lat,latitude,y,y_coord,ycoord,coord_y,point_y,northing,breitengrad,geo_breite,hochwert,"
    "nordwert,latitud,latitudine,breedtegraad,y_wgs84,utm_y,utm_n,"
    "lat (*,latitude (*,y (*,northing (*,lat [*,latitude [*,y [*,northing [*";
// Columns with whole geometries, as text.
constexpr const char* geometry_names = "wkt,the_geom,geom,geometry,wkt_geom,geo_shape";

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
  std::array<char, 512> bytes{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), bytes.size());
  const std::string_view start(bytes.data(), static_cast<std::size_t>(stream.gcount()));
  if (start.starts_with("\xff\xfe") || start.starts_with("\xfe\xff"))
    return "it is text in UTF-16: save it as CSV in UTF-8";
  if (start.starts_with("PK\x03\x04"))
    return "it is an archive or a spreadsheet: unpack it, or save the table as CSV";
  if (const std::string_view packed = describe_packed(start); !packed.empty())
    return "it " + std::string(packed);
  return "its content is none of these; a CSV has the ending .csv or .tsv, and commas, semicolons "
         "or tabs between its columns";
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
  const std::string path = std::filesystem::absolute(inventory.file).string();
  CPLStringList options;
  if (to_lower(inventory.file.extension().string()) == ".csv" ||
      to_lower(inventory.file.extension().string()) == ".tsv") {
    options.SetNameValue("X_POSSIBLE_NAMES", inventory.x.empty() ? x_names : inventory.x.c_str());
    options.SetNameValue("Y_POSSIBLE_NAMES", inventory.y.empty() ? y_names : inventory.y.c_str());
    if (inventory.x.empty()) options.SetNameValue("GEOM_POSSIBLE_NAMES", geometry_names);
  }
  GDALDatasetUniquePtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY,
                                                 drivers.data(), options.List(), nullptr));
  if (!dataset)
    throw Error(inventory.file.string(),
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
  if (dataset.GetLayerCount() == 0) throw Error(file, "has no layer");
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
