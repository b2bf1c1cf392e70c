#include "tools/terrain/height_unit.h"

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <string>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "tools/city/length_unit.h"

namespace nightcity::terrain {

double find_height_unit(GDALRasterBand& band, const OGRSpatialReference* crs,
                        const std::string& file) {
  const std::string said = to_lower(band.GetUnitType());
  const bool is_silent = said.empty() || said == "unknown" || said == "unspecified" ||
                         said == "undefined" || said == "unspec" || said == "none" || said == "n/a";
  if (!is_silent) {
    if (const auto metres = city::find_metres_per(said)) return *metres;
    throw Error(file, "its heights are in the unit \"" + said +
                          "\", which is not known here: write it with heights in metres");
  }
  if (!crs || !crs->IsCompound()) return 1;
  const double metres = crs->GetTargetLinearUnits("VERT_CS");
  return metres > 0 ? metres : 1;
}

bool counts_downward(const OGRSpatialReference* crs) {
  constexpr int third_axis = 2;
  OGRAxisOrientation direction = OAO_Other;
  return crs && crs->GetAxesCount() > third_axis && crs->GetAxis(nullptr, third_axis, &direction) &&
         direction == OAO_Down;
}

}  // namespace nightcity::terrain
