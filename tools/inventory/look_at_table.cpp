#include "tools/inventory/look_at_table.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "formats/to_lower.h"
#include "tools/city/text_encoding.h"
#include "tools/gdal/guarded_gdal.h"
#include "tools/inventory/vector_file.h"

namespace nightcity::inventory {
namespace {

using std::string_view;

// Names of columns in inventories of open portals, in lower case and without other characters, best
// first.
struct Guess {
  string_view property;
  std::initializer_list<string_view> names;
};
const std::array<Guess, 12> guesses{{
    {"id",
     {"poleid", "lampid", "lightid", "assetid", "unitid", "globalid", "objectid", "id", "gid",
      "fid"}},
    {"height",
     {"mountingheight", "mountht", "mountheight", "lampheight", "poleheight", "lichtpunkthoehe",
      "lph", "height", "hoehe", "hgt"}},
    {"lumens", {"lumens", "lumen", "luminousflux", "lightflux", "flux", "lichtstrom"}},
    {"watts", {"wattage", "watts", "watt", "lampwatts", "lampwatt", "leistung", "power"}},
    {"kelvin",
     {"kelvin", "cct", "colortemp", "colourtemp", "colortemperature", "colourtemperature",
      "farbtemperatur"}},
    {"type",
     {"lamptype", "lighttype", "lightsource", "lampsource", "bulbtype", "leuchtmittel",
      "technology", "lamp"}},
    {"mount", {"mounttype", "mounting", "poletype", "masttype", "mastart"}},
    {"direction", {"azimuth", "bearing", "direction", "orientation"}},
    {"count",
     {"lampcount", "numlamps", "nooflamps", "luminairecount", "numberoflights", "anzahlleuchten"}},
    {"state", {"operationalstatus", "lifecyclestatus", "lampstatus", "status", "state"}},
    {"hours", {"burninghours", "operatinghours", "schedule"}},
    {"model", {"luminairemodel", "fixturemodel", "luminaire", "leuchtentyp", "model"}},
}};

std::string simplify(string_view name) {
  std::string out;
  for (const char c : to_lower(name))
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) out += c;
  return out;
}

const std::string* find_column(const TableLook& look, const Guess& guess) {
  for (const string_view name : guess.names)
    for (const std::string& column : look.columns)
      if (simplify(column) == name) return &column;
  return nullptr;
}

bool holds_points(OGRLayer& layer) {
  const OGRwkbGeometryType type = wkbFlatten(layer.GetGeomType());
  if (type == wkbPoint || type == wkbMultiPoint) return true;
  if (type != wkbUnknown) return false;
  layer.ResetReading();
  const OGRFeatureUniquePtr row(layer.GetNextFeature());
  const OGRGeometry* geometry = row ? row->GetGeometryRef() : nullptr;
  return geometry && wkbFlatten(geometry->getGeometryType()) == wkbPoint;
}

}  // namespace

bool is_named_as_table(const std::filesystem::path& file) {
  const std::string ending = to_lower(file.extension().string());
  for (const char* known :
       {".geojson", ".geojsonl", ".csv", ".tsv", ".gpkg", ".shp", ".fgb", ".json"})
    if (ending == known) return true;
  return false;
}

TableLook look_at_table(const std::filesystem::path& file) {
  InventoryFile inventory;
  inventory.file = file;
  const GDALDatasetUniquePtr dataset = open_vector_file(inventory);
  const gdal::Guard guard;
  TableLook look;
  look.format = driver_name(*dataset);
  OGRLayer* chosen = nullptr;
  for (int i = 0; i < dataset->GetLayerCount() && !look.has_points; ++i) {
    OGRLayer* layer = dataset->GetLayer(i);
    look.has_points = holds_points(*layer);
    if (!chosen || look.has_points) chosen = layer;
  }
  if (!chosen) return look;
  look.layer = city::to_valid_utf8(chosen->GetName());
  look.rows = chosen->GetFeatureCount(TRUE);
  if (const OGRSpatialReference* crs = chosen->GetSpatialRef())
    look.crs = crs->GetName() ? crs->GetName() : "unnamed";
  OGRFeatureDefn& columns = *chosen->GetLayerDefn();
  for (int i = 0; i < columns.GetFieldCount(); ++i)
    look.columns.push_back(city::to_valid_utf8(columns.GetFieldDefn(i)->GetNameRef()));
  return look;
}

InventoryFile guess_inventory(const std::filesystem::path& file, const TableLook& look) {
  InventoryFile inventory;
  inventory.file = file;
  for (const Guess& guess : guesses) {
    const std::string* column = find_column(look, guess);
    if (!column) continue;
    if (guess.property == "id")
      inventory.id = *column;
    else
      inventory.columns[std::string(guess.property)] = *column;
  }
  return inventory;
}

}  // namespace nightcity::inventory
