#include "tools/terrain/raster_crs.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>

#include "formats/error.h"

namespace nightcity::terrain {
namespace {

std::optional<OGRSpatialReference> read_prj(const std::string& path) {
  constexpr std::size_t most_bytes = 65536;
  for (const char* ending : {"prj", "PRJ"}) {
    VSILFILE* const file = VSIFOpenL(CPLResetExtension(path.c_str(), ending), "rb");
    if (!file) continue;
    std::string text(most_bytes, '\0');
    text.resize(VSIFReadL(text.data(), 1, text.size(), file));
    VSIFCloseL(file);
    CPLStringList lines;
    lines.AddString(text.c_str());
    OGRSpatialReference crs;
    if (crs.importFromESRI(lines.List()) == OGRERR_NONE && !crs.IsEmpty()) return crs;
  }
  return std::nullopt;
}

}  // namespace

std::optional<OGRSpatialReference> find_raster_crs(GDALDataset& raster, const std::string& path,
                                                   const std::string& name,
                                                   const std::string& otherwise) {
  if (const OGRSpatialReference* own = raster.GetSpatialRef(); own && !own->IsEmpty()) return *own;
  if (const OGRSpatialReference* own = raster.GetGCPSpatialRef();
      raster.GetGCPCount() > 0 && own && !own->IsEmpty())
    return *own;
  if (auto beside = read_prj(path)) return beside;
  if (otherwise.empty()) return std::nullopt;
  OGRSpatialReference crs;
  constexpr const char* const no_files[] = {"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO",
                                            nullptr};
  if (crs.SetFromUserInput(otherwise.c_str(), no_files) != OGRERR_NONE)
    throw Error(name, "PROJ does not know the CRS \"" + otherwise +
                          "\" that [terrain] dem_crs or --dem-crs gives it");
  if (!crs.IsProjected() && !crs.IsGeographic())
    throw Error(name, "the CRS \"" + otherwise +
                          "\" that [terrain] dem_crs or --dem-crs gives it places nothing on "
                          "a map: it is neither projected nor geographic");
  return crs;
}

}  // namespace nightcity::terrain
