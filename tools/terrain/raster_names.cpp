#include "tools/terrain/raster_names.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <system_error>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "tools/city/byte_source.h"
#include "tools/city/packing.h"
#include "tools/terrain/gsi_grid.h"

namespace nightcity::terrain {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 20> raster_endings{
    ".tif", ".tiff", ".asc",  ".xyz", ".hgt", ".img", ".flt", ".bil", ".dem", ".grd",
    ".bt",  ".jp2",  ".sdat", ".rst", ".ter", ".gxf", ".gtx", ".dt0", ".dt1", ".dt2"};
constexpr std::array<std::string_view, 3> text_endings{".txt", ".csv", ".dat"};

// GDAL's own, and those of headers and pixels in the formats of ENVI, Imagine, SAGA, Idrisi and R.
constexpr std::array<std::string_view, 17> companion_endings{
    ".prj", ".hdr", ".aux", ".xml", ".msk",  ".ovr",  ".rrd", ".ige", ".stx",
    ".clr", ".tab", ".gri", ".rsc", ".sgrd", ".mgrd", ".rdc", ".ref"};

// Behind the last underscore of the name.
constexpr std::array<std::string_view, 13> other_layers{
    "edm",   "flm",   "hem",    "wbm",       "msk",       "stk",    "num",
    "shade", "slope", "aspect", "hillshade", "shdrelief", "quality"};

bool is_raster_or_packed(const std::string& name) {
  return city::is_named_as_archive(name) || city::is_named_as_volume(name) ||
         is_named_as_gsi_grid(name) ||
         city::ends_with_any(city::without_stream_ending(name), raster_endings);
}

}  // namespace

bool is_named_as_raster(std::string_view name) {
  return city::ends_with_any(to_lower(name), raster_endings);
}

bool is_named_as_text(std::string_view name) {
  return city::ends_with_any(to_lower(name), text_endings);
}

bool is_named_as_companion(std::string_view name) {
  const std::string ending = to_lower(name.substr(std::min(name.rfind('.'), name.size())));
  // A world file has the first and the last letter of the raster's own ending: .tfw, .j2w.
  const bool is_world_file = ending.ends_with('w') && (ending.size() == 4 || ending.size() == 5);
  return is_world_file || ending == ".wld" || city::ends_with_any(ending, companion_endings);
}

bool is_about_heights(std::string_view name) {
  const std::string path = to_lower(name.substr(0, name.rfind('.')));
  const std::string stem = path.substr(path.find_last_of("/\\") + 1);
  // The distance to what was measured, and its source, beside IGN's RGE ALTI.
  if (stem.starts_with("rgealti_") &&
      (stem.find("_dst_") != std::string::npos || stem.find("_src_") != std::string::npos))
    return true;
  // All that TanDEM-X delivers beside its heights.
  if (stem.starts_with("tdm1_dem_") && !stem.ends_with("_dem")) return true;
  const std::size_t last = stem.rfind('_');
  return last != std::string::npos && std::find(other_layers.begin(), other_layers.end(),
                                                stem.substr(last + 1)) != other_layers.end();
}

std::vector<fs::path> list_raster_files(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return {path};
  std::vector<fs::path> files;
  std::size_t passed_over = 0;
  std::string first;
  fs::recursive_directory_iterator entry(path, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    std::error_code unknown;  // a dangling link is no file
    const std::string name = to_lower(entry->path().filename().string());
    if (name.starts_with('.')) {
      entry.disable_recursion_pending();
    } else if (entry->is_regular_file(unknown) && is_raster_or_packed(name)) {
      if (!is_about_heights(name))
        files.push_back(entry->path());
      else if (passed_over++ == 0)
        first = entry->path().filename().string();
    }
  }
  if (error) throw Error(path.string(), "the folder cannot be read: " + error.message());
  if (files.empty() && passed_over > 0)
    throw Error(path.string(), "the folder holds only rasters whose names speak of no heights (" +
                                   first + "): where they are heights, name the files");
  if (files.empty())
    throw Error(path.string(),
                "no " + city::join_endings(raster_endings) +
                    " (also .gz, .xz, ...) or archive in this folder and those inside it");
  if (passed_over > 0)
    std::fprintf(stderr,
                 "note: %s: %zu rasters were passed over whose names speak of no heights (%s): "
                 "where they are heights, name the files\n",
                 path.c_str(), passed_over, first.c_str());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace nightcity::terrain
