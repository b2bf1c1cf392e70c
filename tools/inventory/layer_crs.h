// The coordinate reference system (CRS) of an inventory, to longitude and latitude.
#pragma once

#include <ogrsf_frmts.h>

#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <string>

#include "tools/georeference/axis_order.h"
#include "tools/georeference/source_crs.h"
#include "tools/inventory/inventory.h"

namespace nightcity::inventory {

class LayerCrs {
 public:
  /// Takes the recipe's CRS, else `of_form` where the form of the table's places says one, else the
  /// layer's. In grids of South Africa and of Krovak, places may be east and north in negative
  /// numbers, or west and south in either order: where the former lie outside the CRS's area of
  /// use, the latter are tried. Throws Error where there is none, or PROJ does not know it.
  LayerCrs(OGRLayer& layer, const InventoryFile& inventory, const std::string& of_form);

  /// Returns WGS 84 degrees of a place of the layer (east or longitude, north or latitude); NaN
  /// where PROJ has no answer.
  glm::dvec2 to_lon_lat(const glm::dvec2& place) const;

  bool is_geographic() const { return crs_->geographic(); }
  /// Returns the zone of UTM that the CRS is; 0 where it is none.
  int utm_zone() const { return zone_; }
  /// Returns what may place its rows wrongly; "" where nothing may.
  std::string doubt() const;

 private:
  void choose_order(const glm::dvec2& middle);
  /// Chooses the operation for a place, as SourceCrs does. Throws Error with the file.
  void select_operation(const glm::dvec2* lon_lat, const std::filesystem::path& file);
  glm::dvec2 to_east_north(const glm::dvec2& place) const;

  std::unique_ptr<georeference::SourceCrs> crs_;
  georeference::AxisOrder order_;  // of the layer's places
  int zone_ = 0;                   // of UTM, which eastings may begin with; 0: it is not UTM
  bool is_outside_ = false;        // of its area of use, in whichever order
};

}  // namespace nightcity::inventory
