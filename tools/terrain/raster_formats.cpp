#include "tools/terrain/raster_formats.h"

#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace nightcity::terrain {
namespace {

// Formats whose file is the raster itself. GDAL has others that are programs in all but name: a VRT
// or WMS file names any other file of this machine, or addresses that GDAL then asks.
constexpr std::array raster_formats{
    "GTiff",       "AAIGrid", "GRASSASCIIGrid", "ISG",       "XYZ",
    "ZMap",        "SRTMHGT", "USGSDEM",        "DTED",      "JDEM",
    "HFA",         "EHdr",    "ENVI",           "AIG",       "GSAG",
    "GSBG",        "GS7BG",   "SAGA",           "RST",       "PCRaster",
    "ILWIS",       "NWT_GRD", "SDTS",           "GXF",       "BT",
    "HF2",         "ACE2",    "SNODAS",         "ROI_PAC",   "ISCE",
    "BYN",         "GTX",     "NGSGEOID",       "Terragen",  "Leveller",
    "SIGDEM",      "RRASTER", "GPKG",           "PNG",       "JPEG",
    "JP2OpenJPEG", "netCDF",  "HDF4",           "HDF4Image", "HDF5",
    "HDF5Image",   "BAG",     "GRIB",           "FITS",      "VICAR",
    "PDS4"};

}  // namespace

const char* const* list_allowed_drivers() {
  static const auto names = [] {
    std::array<const char*, raster_formats.size() + 1> list{};
    std::copy(raster_formats.begin(), raster_formats.end(), list.begin());
    return list;
  }();
  return names.data();
}

const char* find_refused_format(const std::string& file) {
  const GDALDriverH driver = GDALIdentifyDriverEx(file.c_str(), GDAL_OF_RASTER, nullptr, nullptr);
  if (!driver) return nullptr;
  const std::string_view name = GDALGetDriverShortName(driver);
  const bool is_allowed =
      std::find(raster_formats.begin(), raster_formats.end(), name) != raster_formats.end();
  return is_allowed ? nullptr : GDALGetDriverShortName(driver);
}

bool has_text_rows(GDALDataset& raster) {
  GDALDriver* const driver = raster.GetDriver();
  const std::string_view format = driver ? driver->GetDescription() : "";
  return format == "AAIGrid" || format == "GRASSASCIIGrid" || format == "ISG";
}

}  // namespace nightcity::terrain
