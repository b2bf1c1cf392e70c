#include "tools/inventory/layer_crs.h"

#include <cpl_conv.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/error.h"
#include "tools/gdal/utm_zone.h"
#include "tools/georeference/srs_names.h"
#include "tools/inventory/row_places.h"

namespace nightcity::inventory {
namespace {

// Returns the names to try, best first: the register's code, then the definition itself.
std::vector<std::string> list_definitions(OGRLayer& layer, const InventoryFile& inventory,
                                          const std::string& of_form) {
  for (const std::string& name : {inventory.crs, of_form})
    if (!name.empty()) return georeference::list_crs_definitions(name);
  const OGRSpatialReference* said = layer.GetSpatialRef();
  // A GeoPackage has an "Undefined geographic SRS" and a Cartesian one for what nobody knows.
  if (!said || std::string_view(said->GetName() ? said->GetName() : "").starts_with("Undefined"))
    return {};
  std::vector<std::string> definitions;
  OGRSpatialReference crs(*said);
  if (!crs.GetAuthorityCode(nullptr)) crs.AutoIdentifyEPSG();
  if (crs.GetAuthorityName(nullptr) && crs.GetAuthorityCode(nullptr))
    definitions.push_back(std::string(crs.GetAuthorityName(nullptr)) + ":" +
                          crs.GetAuthorityCode(nullptr));
  char* text = nullptr;
  const char* const format[] = {"FORMAT=WKT2_2018", nullptr};
  if (crs.exportToWkt(&text, format) == OGRERR_NONE && text) definitions.emplace_back(text);
  CPLFree(text);
  return definitions;
}

// Returns the median of the layer's places, which rows at 0, 0 or -9999 do not move as they move
// its box.
std::optional<glm::dvec2> find_middle(OGRLayer& layer) {
  constexpr std::size_t enough = 100'000;  // places, for a middle
  std::vector<glm::dvec2> places;
  layer.ResetReading();
  for (OGRFeatureUniquePtr row;
       places.size() < enough && (row = OGRFeatureUniquePtr(layer.GetNextFeature()));)
    for (const glm::dvec2& place : find_places(row->GetGeometryRef()))
      if (!is_unfilled(place)) places.push_back(place);
  layer.ResetReading();
  const glm::dvec2 middle = georeference::find_median(places);
  return std::isfinite(middle.x + middle.y) ? std::optional(middle) : std::nullopt;
}

}  // namespace

LayerCrs::LayerCrs(OGRLayer& layer, const InventoryFile& inventory, const std::string& of_form) {
  const auto definitions = list_definitions(layer, inventory, of_form);
  if (definitions.empty())
    throw Error(inventory.file.string(),
                "names no CRS: say it by crs in [[lamps.inventories]] (\"EPSG:4326\" for longitude "
                "and latitude)");
  using Writer = georeference::SourceCrs::Writer;
  const Writer writer = inventory.crs.empty() ? Writer::stranger : Writer::user;
  std::string why;
  for (const std::string& definition : definitions)
    if ((crs_ = georeference::SourceCrs::create(definition, why, writer))) {
      OGRSpatialReference crs;
      constexpr const char* const no_files[] = {"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO",
                                                nullptr};
      if (crs.SetFromUserInput(definition.c_str(), no_files) == OGRERR_NONE)
        zone_ = crs.GetUTMZone(nullptr);
      break;
    }
  if (!crs_)
    throw Error(inventory.file.string(),
                "has an unknown CRS (" + why + "): say it by crs in [[lamps.inventories]]");
  const auto middle = find_middle(layer);
  if (!middle) {
    select_operation(nullptr, inventory.file);
    return;
  }
  choose_order(*middle);
  const glm::dvec2 lon_lat = crs_->to_own_lon_lat(to_east_north(*middle));
  select_operation(std::isfinite(lon_lat.x + lon_lat.y) ? &lon_lat : nullptr, inventory.file);
}

void LayerCrs::select_operation(const glm::dvec2* lon_lat, const std::filesystem::path& file) {
  try {
    crs_->select_operation(lon_lat);
  } catch (const Error& error) {
    throw Error(file.string(), error.what());
  }
}

void LayerCrs::choose_order(const glm::dvec2& middle) {
  if (crs_->geographic()) return;
  if (!crs_->has_area()) {
    // Nothing but the definition says which way its axes point.
    order_ = {false, crs_->counts_west_and_south() ? -1.0 : 1.0};
    return;
  }
  const auto lies_in_area = [&](const georeference::AxisOrder& order) {
    order_ = order;
    return crs_->area_contains(crs_->to_own_lon_lat(to_east_north(middle)), 0);
  };
  is_outside_ =
      !lies_in_area({false, 1}) && !lies_in_area({false, -1}) && !lies_in_area({true, -1});
  if (is_outside_) order_ = {};
}

std::string LayerCrs::doubt() const {
  if (!is_outside_) return crs_->doubt();
  return "most of its places lie outside of the area of its CRS: is that right, and x east?";
}

glm::dvec2 LayerCrs::to_east_north(const glm::dvec2& place) const {
  const glm::dvec2 in_zone(gdal::take_zone_off(place.x, zone_), place.y);
  const glm::dvec2 turned = order_.east_north({in_zone, 0});
  return crs_->to_metres_or_degrees(turned);
}

glm::dvec2 LayerCrs::to_lon_lat(const glm::dvec2& place) const {
  return crs_->to_wgs84(to_east_north(place));
}

}  // namespace nightcity::inventory
