// The coordinate reference system (CRS) of an inventory, to longitude and latitude.
#pragma once

#include <ogrsf_frmts.h>

#include <glm/vec2.hpp>
#include <memory>

#include "tools/georeference/source_crs.h"
#include "tools/inventory/inventory.h"

namespace nightcity::inventory {

class LayerCrs {
 public:
  /// Takes the recipe's CRS, else the layer's. Throws Error where there is none, or PROJ does not
  /// know it.
  LayerCrs(OGRLayer& layer, const InventoryFile& inventory);

  /// Returns WGS 84 degrees of a place of the layer (east or longitude, north or latitude); NaN
  /// where PROJ has no answer.
  glm::dvec2 to_lon_lat(const glm::dvec2& place) const;

  bool is_geographic() const { return crs_->geographic(); }

 private:
  std::unique_ptr<georeference::SourceCrs> crs_;
};

}  // namespace nightcity::inventory
