#include "tools/survey/survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "tools/city/archive_entries.h"
#include "tools/city/byte_source.h"
#include "tools/city/text_encoding.h"
#include "tools/georeference/frame.h"
#include "tools/inputs/city_files.h"
#include "tools/inputs/file_format.h"
#include "tools/inputs/read_city.h"
#include "tools/inventory/look_at_table.h"
#include "tools/inventory/read_inventory.h"
#include "tools/lights/luminaire.h"
#include "tools/osm/read_osm.h"
#include "tools/survey/place_tables.h"
#include "tools/terrain/open_models.h"
#include "tools/terrain/packed_rasters.h"

namespace nightcity::survey {
namespace {

namespace fs = std::filesystem;

// Endings of files that belong to others.
constexpr std::array<std::string_view, 20> companion_endings{
    ".mtl", ".png", ".jpg", ".jpeg", ".dbf", ".shx", ".prj",  ".cpg", ".qix", ".qmd",
    ".sbn", ".sbx", ".tfw", ".aux",  ".md",  ".pdf", ".toml", ".xsd", ".bin", ".ktx2"};

bool is_companion(const fs::path& file) {
  const std::string ending = to_lower(file.extension().string());
  return std::find(companion_endings.begin(), companion_endings.end(), ending) !=
         companion_endings.end();
}

void look_at_city(SurveyedFile& file, const std::string& format) {
  const city::CityHead head = inputs::read_city_head(file.path);
  file.use = Use::city;
  file.is_obj = format == "Wavefront OBJ";
  file.what = format + (head.version.empty() ? "" : " " + head.version);
  for (const city::Document& document : city::list_documents(file.path, inputs::city_endings())) {
    const auto has = [&](const std::string& name) {
      return city::mentions(document, ":" + name) || city::mentions(document, "<" + name) ||
             city::mentions(document, "\"" + name + "\"");
    };
    file.has_roads = file.has_roads || has("Road") || has("TrafficArea");
    file.has_relief = file.has_relief || has("ReliefFeature") || has("TINRelief");
  }
  if (head.sample.empty()) {
    file.use = Use::nothing;
    file.what += ", without geometry";
    return;
  }
  try {
    const auto frame = georeference::CityFrame::from_srs_name(head.srs_name, head.sample, {});
    file.has_crs = frame.has_lon_lat();
    file.what += file.has_crs ? ", " + frame.description() : ", names no CRS";
    if (!file.has_crs) return;
    file.crs = frame.crs();
    std::vector<glm::dvec3> places = head.sample;
    frame.to_projected(places);
    for (const glm::dvec3& p : places) file.box.add(frame.to_lon_lat(glm::dvec2(p)));
  } catch (const Error& error) {
    file.what += ", its CRS cannot be used: " + std::string(error.what());
  }
}

void look_at_map(SurveyedFile& file) {
  const osm::OsmData map = osm::read_osm(file.path);
  file.use = Use::map;
  file.has_crs = true;
  file.lamps = map.lamps.size();
  file.streets = map.highways.size();
  file.buildings = map.buildings.size();
  file.what = fmt::format("OpenStreetMap, {} lamps, {} streets, {} buildings", file.lamps,
                          file.streets, file.buildings);
  for (const auto* ways : {&map.highways, &map.buildings})
    for (const osm::OsmWay& way : *ways)
      for (const glm::dvec2& p : way.lon_lat) file.box.add(p);
  for (const osm::OsmLampNode& lamp : map.lamps) file.box.add(lamp.lon_lat);
}

void look_at_table(SurveyedFile& file) {
  const inventory::TableLook look = inventory::look_at_table(file.path);
  // Many kinds of JSON have lists of objects.
  if (!look.has_points && look.format == "JSON") throw inventory::NoTable("", "has no points");
  if (!look.has_points) {
    file.what = look.format + " without points: a table of lamps has a point in each row";
    return;
  }
  const auto has = [&](const char* column) {
    return std::find(look.columns.begin(), look.columns.end(), column) != look.columns.end();
  };
  if (has("position_from") && has("flux_from")) {
    file.what = "lights of a finished scene (nightbake export), not what one is made from";
    return;
  }
  inventory::InventoryFile guess = inventory::guess_inventory(file.path, look);
  guess.layer = look.layer;
  file.what = fmt::format("{}, {} points, columns", look.format, look.rows);
  for (const std::string& column : look.columns) file.what += " " + column;
  file.has_crs = !look.crs.empty();
  if (!file.has_crs) {
    guess.crs = "EPSG:4326";
    file.what += std::string("; names no CRS: ") + assumed_degrees;
  }
  // Trees and benches are points too.
  if (!look.speaks_of_lamps) {
    file.what +=
        ": nothing in these names speaks of lamps; a table that holds some belongs in "
        "[[lamps.inventories]]";
    return;
  }
  file.inventory = std::move(guess);
  try {
    read_lamps(file);
  } catch (const inventory::OutsideCrs&) {
    if (file.has_crs) throw;  // else it waits for place_tables()
  }
  file.use = Use::inventory;
}

void look_at_raster(SurveyedFile& file) {
  const std::vector<terrain::ElevationModel> models =
      terrain::open_elevation_models({file.path}, {});
  const auto has_crs = [](const terrain::ElevationModel& model) { return model.has_crs(); };
  file.use = Use::elevation;
  file.has_crs = std::all_of(models.begin(), models.end(), has_crs);
  file.crs = models.front().crs();
  file.what = models.size() == 1 ? "raster of heights"
                                 : fmt::format("{} rasters of heights", models.size());
  file.what +=
      fmt::format(", one every {:.3g} m{}", models.front().resolution_m(),
                  file.has_crs ? "" : ", names no CRS: [terrain] dem_crs, else the city's");
  if (!models.front().assumption().empty()) file.what += ", " + models.front().assumption();
}

void look_at_luminaire(SurveyedFile& file, const std::string& format) {
  const lights::Luminaire luminaire = lights::read_luminaire(file.path);
  file.use = Use::luminaire;
  file.what = fmt::format("{}, photometry of a luminaire of {:.0f} lm", format, luminaire.flux_lm);
}

// Tells what else an archive holds that a recipe could name: of its kinds one is read.
void tell_unread(SurveyedFile& file, inputs::FileKind read) {
  constexpr std::array<std::string_view, 17> useful{
      ".csv", ".tsv", ".geojson", ".json", ".shp", ".gpkg", ".fgb", ".tif", ".tiff",
      ".asc", ".xyz", ".pbf",     ".osm",  ".ies", ".ldt",  ".gml", ".obj"};
  const city::FileContents contents = inputs::list_readable(file.path);
  std::string unread;
  const auto add = [&](const std::string& what) { unread += (unread.empty() ? "" : ", ") + what; };
  for (const city::Document& document : contents.documents) {
    const inputs::FileFormat* format = inputs::find_format(document);
    if (format && format->kind != read)
      add(fs::path(document.name).filename().string() + " (" + format->name + ")");
  }
  for (const auto& [ending, count] : contents.others)
    if (std::find(useful.begin(), useful.end(), ending) != useful.end())
      add(fmt::format("{} {}", count, ending));
  if (!unread.empty()) file.what += "; unpack it for what else it holds: " + unread;
}

void look_at_format(SurveyedFile& file) {
  const inputs::FileFormat& format = inputs::find_format(file.path);
  switch (format.kind) {
    case inputs::FileKind::city:
      look_at_city(file, format.name);
      return tell_unread(file, format.kind);
    case inputs::FileKind::osm:
      look_at_map(file);
      return tell_unread(file, format.kind);
    case inputs::FileKind::luminaire:
      return look_at_luminaire(file, format.name);
    case inputs::FileKind::scene:
    case inputs::FileKind::lights:
      file.what = std::string(format.name) +
                  ": a finished scene, not what one is made from; a model is exported as Wavefront "
                  "OBJ (Blender does)";
  }
}

bool is_archive_of_rasters(const fs::path& path) {
  try {
    return terrain::holds_packed_rasters(path);
  } catch (const Error&) {
    return false;  // broken, as the attempts to read it say
  }
}

SurveyedFile look_at(const fs::path& path) {
  SurveyedFile file;
  file.path = path;
  std::string why;
  bool is_table = true;  // or broken, and not of another kind
  const auto attempt = [&](const auto& look) {
    try {
      look(file);
      return true;
    } catch (const inventory::NoTable& error) {
      is_table = false;
      if (why.empty()) why = error.what();
      return false;
    } catch (const Error& error) {
      if (why.empty()) why = error.what();
      return false;
    }
  };
  if (is_companion(path)) {
    file.use = Use::companion;
    return file;
  }
  if (city::to_valid_utf8(path.string()) != path.string()) {
    file.what = "its name is not in UTF-8, as a recipe is: rename it";
    return file;
  }
  if (attempt(look_at_format)) return file;
  // Texts are heights, a table or, mostly, words for a reader.
  if (to_lower(path.extension().string()) == ".txt") {
    if (attempt(look_at_raster) || (attempt(look_at_table) && file.use == Use::inventory))
      return file;
    file = {};
    file.path = path;
    file.use = Use::companion;
    return file;
  }
  // An archive of an elevation model may hold a table of its tiles, too.
  if (is_archive_of_rasters(path)) {
    const std::string as_other = std::exchange(why, {});
    if (attempt(look_at_raster)) return file;
    if (why.empty()) why = as_other;
  }
  if (inventory::may_be_table(path)) {
    const std::string as_other = std::exchange(why, {});
    if (attempt(look_at_table)) return file;
    // The words for what a table lacks say more than that it is no city model; but JSON and
    // archives may be anything.
    constexpr std::array<std::string_view, 4> of_all_kinds{".json", ".jsonl", ".ndjson", ".shz"};
    if (!is_table && (city::ends_with_any(to_lower(path.string()), of_all_kinds) ||
                      city::find_packing_of(path) != city::Packing::none))
      why = as_other;
  }
  try {
    look_at_raster(file);
    return file;
  } catch (const terrain::NoRaster&) {  // it has been said what it is
  } catch (const Error& error) {        // a raster that holds no heights, unless it is a table
    if (why.empty() || !inventory::may_be_table(path)) why = error.what();
  }
  file.use = Use::nothing;
  const std::string prefix = path.string() + ": ";
  file.what = why.starts_with(prefix) ? why.substr(prefix.size()) : why;
  return file;
}

bool is_hidden(const fs::path& path) {
  return path.filename().string().starts_with('.');
}

void list_files(const fs::path& path, std::set<fs::path>& files) {
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    if (!fs::exists(path, error)) throw Error(path.string(), "is not there");
    files.insert(path);
    return;
  }
  fs::recursive_directory_iterator entry(path, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    std::error_code unknown;
    if (is_hidden(entry->path()))
      entry.disable_recursion_pending();
    else if (entry->is_regular_file(unknown))
      files.insert(entry->path());
  }
  if (error) throw Error(path.string(), "the folder cannot be read: " + error.message());
}

}  // namespace

std::vector<SurveyedFile> survey_files(const std::vector<fs::path>& paths) {
  std::set<fs::path> files;
  for (const fs::path& path : paths) list_files(path.lexically_normal(), files);
  std::vector<SurveyedFile> result;
  for (const fs::path& file : files) result.push_back(look_at(file));
  place_tables(result);
  return result;
}

}  // namespace nightcity::survey
