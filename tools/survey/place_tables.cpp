#include "tools/survey/place_tables.h"

#include <algorithm>
#include <string>

#include "formats/error.h"
#include "tools/georeference/utm_zone.h"
#include "tools/inventory/read_inventory.h"

namespace nightcity::survey {
namespace {

// Returns the CRSs that a table beside these files may have, the likeliest first.
std::vector<std::string> list_usual_crs(const std::vector<SurveyedFile>& files) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  };
  for (const Use use : {Use::city, Use::elevation})
    for (const SurveyedFile& file : files)
      if (file.use == use) add(file.crs);
  add("EPSG:3857");
  for (const SurveyedFile& file : files)
    if (!file.box.empty()) add(georeference::find_utm_zone(file.box.middle()));
  return names;
}

// Gives a table whose places are no degrees the first CRS by which it lies beside the others.
void place_table(SurveyedFile& table, const std::vector<SurveyedFile>& files,
                 const std::vector<std::string>& names) {
  constexpr double near_degrees = 0.05;  // 5 km
  for (const std::string& name : names) {
    table.inventory->crs = name;
    table.box = {};
    try {
      read_lamps(table);
    } catch (const Error&) {
      continue;  // its places are outside of this one, too
    }
    if (std::any_of(files.begin(), files.end(), [&](const SurveyedFile& file) {
          return file.has_crs && file.box.is_near(table.box, near_degrees);
        })) {
      const std::size_t at = table.what.rfind(assumed_degrees);
      table.what.replace(at, table.what.size() - at,
                         name + " is assumed, by which its places lie beside the other files");
      return;
    }
  }
  table.use = Use::nothing;
  table.inventory.reset();
  table.what += ", which its places are not: say the CRS by crs in [[lamps.inventories]]";
}

}  // namespace

void read_lamps(SurveyedFile& table) {
  const inventory::Inventory read = inventory::read_inventory(*table.inventory);
  for (const osm::OsmLampNode& lamp : read.lamps) table.box.add(lamp.lon_lat);
  table.lamps = read.lamps.size();
}

void place_tables(std::vector<SurveyedFile>& files) {
  const std::vector<std::string> names = list_usual_crs(files);
  for (SurveyedFile& file : files)
    if (file.use == Use::inventory && !file.has_crs && file.box.empty())
      place_table(file, files, names);
}

}  // namespace nightcity::survey
