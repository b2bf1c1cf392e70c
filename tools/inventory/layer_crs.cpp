#include "tools/inventory/layer_crs.h"

#include <cpl_conv.h>
#include <ogr_spatialref.h>

#include <string>
#include <vector>

#include "formats/error.h"
#include "tools/georeference/srs_names.h"

namespace nightcity::inventory {
namespace {

// Returns the names to try, best first: the register's code, then the definition itself.
std::vector<std::string> list_definitions(OGRLayer& layer, const InventoryFile& inventory) {
  if (!inventory.crs.empty()) return georeference::list_crs_definitions(inventory.crs);
  const OGRSpatialReference* said = layer.GetSpatialRef();
  if (!said) return {};
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

}  // namespace

LayerCrs::LayerCrs(OGRLayer& layer, const InventoryFile& inventory) {
  const auto definitions = list_definitions(layer, inventory);
  if (definitions.empty())
    throw Error(inventory.file.string(),
                "names no CRS: say it by crs in [[lamps.inventories]] (\"EPSG:4326\" for longitude "
                "and latitude)");
  using Writer = georeference::SourceCrs::Writer;
  const Writer writer = inventory.crs.empty() ? Writer::stranger : Writer::user;
  std::string why;
  for (const std::string& definition : definitions)
    if ((crs_ = georeference::SourceCrs::create(definition, why, writer))) break;
  if (!crs_)
    throw Error(inventory.file.string(),
                "has an unknown CRS (" + why + "): say it by crs in [[lamps.inventories]]");
  const auto select_operation = [&](const glm::dvec2* lon_lat) {
    try {
      crs_->select_operation(lon_lat);
    } catch (const Error& error) {
      throw Error(inventory.file.string(), error.what());
    }
  };
  OGREnvelope box;
  if (layer.GetExtent(&box, TRUE) != OGRERR_NONE) {
    select_operation(nullptr);
    return;
  }
  const glm::dvec2 middle((box.MinX + box.MaxX) / 2, (box.MinY + box.MaxY) / 2);
  const auto lies_in_area = [&](const georeference::AxisOrder& order) {
    order_ = order;
    return crs_->area_contains(crs_->to_own_lon_lat(to_east_north(middle)), 0);
  };
  if (!crs_->geographic() && !lies_in_area({false, 1}) && !lies_in_area({false, -1}) &&
      !lies_in_area({true, -1}))
    order_ = {};
  const glm::dvec2 lon_lat = crs_->to_own_lon_lat(to_east_north(middle));
  select_operation(std::isfinite(lon_lat.x + lon_lat.y) ? &lon_lat : nullptr);
}

glm::dvec2 LayerCrs::to_east_north(const glm::dvec2& place) const {
  const glm::dvec2 turned = order_.east_north({place, 0});
  return crs_->to_metres_or_degrees(turned);
}

glm::dvec2 LayerCrs::to_lon_lat(const glm::dvec2& place) const {
  return crs_->to_wgs84(to_east_north(place));
}

}  // namespace nightcity::inventory
