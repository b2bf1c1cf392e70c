#include "tools/inventory/vector_file.h"

#include <cpl_conv.h>

#include <array>
#include <string>
#include <system_error>

#include "formats/error.h"
#include "formats/input_file.h"
#include "formats/to_lower.h"
#include "tools/gdal/guarded_gdal.h"

namespace nightcity::inventory {
namespace {

constexpr std::array drivers{
    "GeoJSON", "GeoJSONSeq",     "ESRIJSON",   "CSV",
    "GPKG",    "ESRI Shapefile", "FlatGeobuf", static_cast<const char*>(nullptr)};

// Names of columns with coordinates that open portals use.
constexpr const char* x_names =
    "lon,long,lng,longitude,x,x_coord,xcoord,point_x,easting,laengengrad";
constexpr const char* y_names = "lat,latitude,y,y_coord,ycoord,point_y,northing,breitengrad";

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
  }
  GDALDatasetUniquePtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY,
                                                 drivers.data(), options.List(), nullptr));
  if (!dataset)
    throw Error(inventory.file.string(),
                "is no table of lamps that can be read (GeoJSON, CSV, GeoPackage, Shapefile, "
                "FlatGeobuf): " +
                    gdal::find_reason());
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

const char* driver_name(GDALDataset& dataset) {
  return dataset.GetDriver() ? dataset.GetDriver()->GetDescription() : "";
}

}  // namespace nightcity::inventory
