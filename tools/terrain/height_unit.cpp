#include "tools/terrain/height_unit.h"

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <string>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "tools/city/length_unit.h"

namespace nightcity::terrain {

namespace {

// Returns the unit that the band names, in lower case; "" where it names none.
std::string find_band_unit(GDALRasterBand& band) {
  const std::string said = to_lower(band.GetUnitType());
  for (const char* silent : {"unknown", "unspecified", "undefined", "unspec", "none", "n/a"})
    if (said == silent) return {};
  return said;
}

}  // namespace

double find_height_unit(GDALRasterBand& band, const OGRSpatialReference* crs,
                        const std::string& file) {
  const std::string said = find_band_unit(band);
  if (!said.empty()) {
    if (const auto metres = city::find_metres_per(said)) return *metres;
    throw Error(file, "its heights are in the unit \"" + said +
                          "\", which is not known here: write it with heights in metres");
  }
  if (!crs || !crs->IsCompound()) return 1;
  const double metres = crs->GetTargetLinearUnits("VERT_CS");
  return metres > 0 ? metres : 1;
}

bool assumes_metres(GDALRasterBand& band, const OGRSpatialReference* crs) {
  constexpr double not_metres = 1e-6;
  return crs && crs->IsProjected() && !crs->IsCompound() && find_band_unit(band).empty() &&
         std::abs(crs->GetLinearUnits() - 1) > not_metres;
}

bool counts_downward(const OGRSpatialReference* crs) {
  constexpr int third_axis = 2;
  OGRAxisOrientation direction = OAO_Other;
  return crs && crs->GetAxesCount() > third_axis && crs->GetAxis(nullptr, third_axis, &direction) &&
         direction == OAO_Down;
}

}  // namespace nightcity::terrain
