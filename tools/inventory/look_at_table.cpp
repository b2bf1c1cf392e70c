#include "tools/inventory/look_at_table.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "formats/to_lower.h"
#include "tools/city/archive_entries.h"
#include "tools/city/text_encoding.h"
#include "tools/gdal/guarded_gdal.h"
#include "tools/inventory/text_places.h"
#include "tools/inventory/vector_file.h"

namespace nightcity::inventory {
namespace {

using std::string_view;

// Names of columns in inventories of open portals, in lower case and without blanks, signs and
// units, best first.
struct Guess {
  string_view property;
  std::initializer_list<string_view> names;
};
const std::array<Guess, 12> guesses{{
    {"id",
     {"poleid", "lampid", "lightid", "assetid", "unitid", "globalid", "objectid", "id", "gid",
      "fid"}},
    {"height",
     {"mountingheight",
      "mountht",
      "mountheight",
      "lampheight",
      "poleheight",
      "lichtpunkthoehe",
      "lichtpunkthöhe",
      "lph",
      "height",
      "hoehe",
      "höhe",
      "hgt",
      "hauteurfeu",
      "hauteur",
      "lichtpunthoogte",
      "lichtmasthoogte",
      "masthoogte",
      "hoogte",
      "altura",
      "altezza",
      "hojd",
      "höjd",
      "hojde",
      "højde",
      "høyde",
      "wysokosc",
      "wysokość",
      "vyska",
      "výška",
      "korkeus",
      "korgus",
      "kõrgus"}},
    {"lumens",
     {"lumens", "lumen", "luminousflux", "lightflux", "flux", "lichtstrom", "lichtstroom",
      "fluxlumineux", "flujoluminoso", "flussoluminoso"}},
    {"watts",
     {"wattage", "watts", "watt", "lampwattage", "lampwatts", "lampwatt", "leistung", "power",
      "puissance", "potencia", "potenza", "vermogen", "effekt", "teho", "prikon", "příkon", "moc",
      "voimsus", "võimsus"}},
    {"kelvin",
     {"kelvin", "cct", "colortemp", "colourtemp", "colortemperature", "colourtemperature",
      "farbtemperatur", "temperaturecouleur", "temperaturacolor", "temperaturacolore",
      "kleurtemperatuur", "fargetemperatur", "färgtemperatur"}},
    {"type",
     {"lamptype", "lighttype", "lightsource", "lampsource", "bulbtype", "leuchtmittel",
      "technology", "lamp", "typelampe", "tipolampara", "tipolámpara", "tipolampada",
      "lampputyyppi", "lamptyp", "lampentyp", "typlampy"}},
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
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80)
      out += c;
  return out;
}

constexpr const char* shapefile = "ESRI Shapefile";

// Returns whether the text is that of a unit: MOUNT_HT_FT.
bool is_unit(string_view text) {
  constexpr std::array<string_view, 9> units{"m", "meter", "ft", "feet", "cm",
                                             "w", "watt",  "lm", "k"};
  return std::find(units.begin(), units.end(), text) != units.end();
}

// Returns whether a column has that name; a Shapefile cuts "mounting_height" to "mounting_h".
bool is_named(const std::string& column, string_view name, bool in_shapefile) {
  constexpr std::size_t longest = 10, least_letters = 8;
  // Without the unit of "Mounting height (ft)".
  const std::string simple = simplify(string_view(column).substr(0, column.find_first_of("([")));
  if (simple.starts_with(name) && is_unit(string_view(simple).substr(name.size()))) return true;
  return simple == name || (in_shapefile && column.size() == longest &&
                            simple.size() >= least_letters && name.starts_with(simple));
}

const std::string* find_column(const TableLook& look, const Guess& guess) {
  for (const string_view name : guess.names)
    for (const std::string& column : look.columns)
      if (is_named(column, name, look.format == shapefile)) return &column;
  return nullptr;
}

bool is_point(OGRwkbGeometryType type) {
  return wkbFlatten(type) == wkbPoint || wkbFlatten(type) == wkbMultiPoint;
}

bool holds_points(OGRLayer& layer, const InventoryFile& inventory) {
  if (is_point(layer.GetGeomType()) || find_point_column(layer) >= 0) return true;
  const TextPlaces texts(layer, inventory);
  if (texts.begins_with_angles() || texts.begins_with_groups()) return true;
  if (wkbFlatten(layer.GetGeomType()) != wkbUnknown) return false;
  // The first rows may be those without a place.
  constexpr int first_rows = 100;
  layer.ResetReading();
  for (int i = 0; i < first_rows; ++i) {
    const OGRFeatureUniquePtr row(layer.GetNextFeature());
    if (!row) break;
    const OGRGeometry* geometry = row->GetGeometryRef();
    const OGRGeometryUniquePtr as_text = geometry ? nullptr : texts.read_geometry(*row);
    if (!geometry) geometry = as_text.get();
    if (geometry) return is_point(geometry->getGeometryType());
  }
  return false;
}

// Words for lamps and lighting in the languages of open portals.
bool is_name_of_lamps(string_view text) {
  constexpr std::array<string_view, 40> words{
      "lamp",     "light",    "lumin",    "leucht",    "licht",    "clairage", "lantern",
      "latern",   "latarn",   "farol",    "belysning", "valaisin", "osvetl",   "oswietl",
      "alumbrad", "candelab", "reverber", "réverbèr",  "osvětlen", "oświetl",  "svetil",
      "rasvjet",  "rasvet",   "valgusti", "apsviet",   "apgaism",  "vilagit",  "világít",
      "aydinlat", "aydınlat", "gatelys",  "gadelys",   "освещ",    "фонар",    "светил",
      "φωτισμ",   "照明",     "路灯",     "街灯",      "가로등"};
  // Traffic lights and highlights hold some of these words, too.
  constexpr std::array<string_view, 7> others{"signal",     "traffic", "verkeersli", "lightning",
                                              "lighthouse", "flight",  "highlight"};
  const std::string name = to_lower(text);
  const auto holds = [&](string_view word) { return name.find(word) != std::string::npos; };
  return std::any_of(words.begin(), words.end(), holds) &&
         std::none_of(others.begin(), others.end(), holds);
}

// Rates how well a layer's name and columns speak of lamps.
int rate_as_lamps(OGRLayer& layer, const std::string& format) {
  constexpr int weight_of_name = 3;
  int rate = is_name_of_lamps(layer.GetName()) ? weight_of_name : 0;
  TableLook look;
  look.format = format;
  OGRFeatureDefn& columns = *layer.GetLayerDefn();
  for (int i = 0; i < columns.GetFieldCount(); ++i)
    look.columns.emplace_back(columns.GetFieldDefn(i)->GetNameRef());
  for (const Guess& guess : guesses)
    if (guess.property != "id" && guess.property != "height" && find_column(look, guess)) ++rate;
  return rate;
}

}  // namespace

bool may_be_table(const std::filesystem::path& file) {
  const std::string ending = to_lower(file.extension().string());
  for (const char* known : {".geojson", ".geojsonl", ".csv", ".tsv", ".gpkg", ".shp", ".fgb",
                            ".json", ".jsonl", ".ndjson", ".shz"})
    if (ending == known) return true;
  return city::find_packing_of(file) != city::Packing::none;
}

TableLook look_at_table(const std::filesystem::path& file) {
  InventoryFile inventory;
  inventory.file = file;
  const VectorFile table = open_vector_file(inventory);
  GDALDataset* const dataset = table.dataset.get();
  const gdal::Guard guard;
  TableLook look;
  look.format = table.format;
  OGRLayer* chosen = nullptr;
  int best = -1;  // of layers with points, the one that speaks most of lamps is taken
  for (int i = 0; i < dataset->GetLayerCount(); ++i) {
    OGRLayer* layer = dataset->GetLayer(i);
    const int rate = holds_points(*layer, inventory) ? rate_as_lamps(*layer, look.format) : -1;
    look.has_points = look.has_points || rate >= 0;
    if (!chosen || rate > best) chosen = layer;
    best = std::max(best, rate);
  }
  look.speaks_of_lamps =
      best > 0 || is_name_of_lamps(file.stem().string()) || is_name_of_lamps(table.stem);
  if (!chosen) return look;
  look.layer = city::to_valid_utf8(chosen->GetName());
  look.rows = chosen->GetFeatureCount(TRUE);
  if (const OGRSpatialReference* crs = chosen->GetSpatialRef(); crs && table.crs.empty())
    look.crs = crs->GetName() ? crs->GetName() : "unnamed";
  else
    look.crs = table.crs.empty() ? TextPlaces(*chosen, inventory).crs() : table.crs;
  OGRFeatureDefn& columns = *chosen->GetLayerDefn();
  for (int i = 0; i < columns.GetFieldCount(); ++i)
    look.columns.push_back(city::decode_text(columns.GetFieldDefn(i)->GetNameRef()));
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
