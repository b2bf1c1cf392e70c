#include "tools/terrain/raster_crs.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>

#include <string_view>
#include <utility>

#include "formats/error.h"
#include "tools/city/attributes.h"
#include "tools/city/text_encoding.h"

namespace nightcity::terrain {
namespace {

constexpr const char* const no_files[] = {"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO",
                                          nullptr};

// Returns what a .prj says: a definition as Esri writes them, or "EPSG:25833" and the like.
std::optional<OGRSpatialReference> parse_prj(std::string text) {
  constexpr std::string_view mark_of_utf8 = "\xef\xbb\xbf";
  text = city::to_utf8(std::move(text));
  if (text.starts_with(mark_of_utf8)) text.erase(0, mark_of_utf8.size());
  CPLStringList lines;
  lines.AddString(text.c_str());
  OGRSpatialReference crs;
  if (crs.importFromESRI(lines.List()) == OGRERR_NONE && !crs.IsEmpty()) return crs;
  const std::string name(city::trim(text));
  const bool places = !name.empty() &&
                      crs.SetFromUserInput(name.c_str(), no_files) == OGRERR_NONE &&
                      (crs.IsProjected() || crs.IsGeographic());
  return places ? std::optional(crs) : std::nullopt;
}

std::optional<OGRSpatialReference> read_prj(const std::string& path) {
  constexpr std::size_t most_bytes = 65536;
  for (const char* ending : {"prj", "PRJ"}) {
    VSILFILE* const file = VSIFOpenL(CPLResetExtension(path.c_str(), ending), "rb");
    if (!file) continue;
    std::string text(most_bytes, '\0');
    text.resize(VSIFReadL(text.data(), 1, text.size(), file));
    VSIFCloseL(file);
    if (auto crs = parse_prj(std::move(text))) return crs;
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
