#include "tools/survey/looks.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "tools/city/byte_source.h"
#include "tools/georeference/frame.h"
#include "tools/inputs/city_files.h"
#include "tools/inputs/read_city.h"
#include "tools/inventory/look_at_table.h"
#include "tools/inventory/read_inventory.h"
#include "tools/lights/luminaire.h"
#include "tools/osm/read_osm.h"
#include "tools/survey/place_tables.h"
#include "tools/terrain/open_models.h"

namespace nightcity::survey {

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

}  // namespace nightcity::survey
