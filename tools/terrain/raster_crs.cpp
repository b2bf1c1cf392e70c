#include "tools/terrain/raster_crs.h"

#include <cpl_string.h>

#include <fstream>

#include "formats/error.h"

namespace nightcity::terrain {
namespace {

std::optional<OGRSpatialReference> read_prj(const std::filesystem::path& file) {
  constexpr std::size_t most_bytes = 65536;
  for (const char* ending : {".prj", ".PRJ"}) {
    std::ifstream stream(std::filesystem::path(file).replace_extension(ending));
    std::string text(most_bytes, '\0');
    if (!stream.read(text.data(), most_bytes) && stream.gcount() == 0) continue;
    text.resize(static_cast<std::size_t>(stream.gcount()));
    CPLStringList lines;
    lines.AddString(text.c_str());
    OGRSpatialReference crs;
    if (crs.importFromESRI(lines.List()) == OGRERR_NONE && !crs.IsEmpty()) return crs;
  }
  return std::nullopt;
}

}  // namespace

std::optional<OGRSpatialReference> find_raster_crs(GDALDataset& raster,
                                                   const std::filesystem::path& file,
                                                   const std::string& otherwise) {
  if (const OGRSpatialReference* own = raster.GetSpatialRef(); own && !own->IsEmpty()) return *own;
  if (const OGRSpatialReference* own = raster.GetGCPSpatialRef();
      raster.GetGCPCount() > 0 && own && !own->IsEmpty())
    return *own;
  if (auto beside = read_prj(file)) return beside;
  if (otherwise.empty()) return std::nullopt;
  OGRSpatialReference crs;
  constexpr const char* const no_files[] = {"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO",
                                            nullptr};
  if (crs.SetFromUserInput(otherwise.c_str(), no_files) != OGRERR_NONE)
    throw Error(file.string(), "PROJ does not know the CRS \"" + otherwise +
                                   "\" that [terrain] dem_crs or --dem-crs gives it");
  if (!crs.IsProjected() && !crs.IsGeographic())
    throw Error(file.string(),
                "the CRS \"" + otherwise +
                    "\" that [terrain] dem_crs or --dem-crs gives it places nothing on "
                    "a map: it is neither projected nor geographic");
  return crs;
}

}  // namespace nightcity::terrain
