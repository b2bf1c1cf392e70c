#include "tools/terrain/packed_rasters.h"

#include <cpl_conv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <set>
#include <string_view>
#include <utility>

#include "formats/error.h"
#include "formats/file_names.h"
#include "formats/to_lower.h"
#include "tools/city/packing.h"
#include "tools/city/text_encoding.h"
#include "tools/gdal/guarded_gdal.h"
#include "tools/terrain/gsi_grid.h"
#include "tools/terrain/height_words.h"
#include "tools/terrain/raster_names.h"
#include "tools/terrain/text_rasters.h"

namespace nightcity::terrain {
namespace {

constexpr std::array<std::string_view, 1> any_ending{""};

// Returns a name with its folders but without what stands behind its first point, in lower case:
// "a.tif", "a.tfw" and "a.tif.aux.xml" belong together.
std::string find_stem(std::string_view name) {
  const std::size_t folders = name.find_last_of("/\\") + 1;  // npos + 1 is 0
  return to_lower(name.substr(0, name.find('.', folders)));
}

std::string read_start_as_it_is(const city::Document& document) {
  constexpr std::size_t enough = 512;
  return city::read_next(*document.open_as_it_is(), enough);
}

bool is_to_be_straightened(const city::Document& text) {
  const std::string start = read_start_as_it_is(text);
  return is_odd_text(start) || (begins_as_text(start) && has_height_words(text.open_as_it_is()));
}

bool is_raster_name(const std::string& name) {
  return is_named_as_raster(name) || is_named_as_gsi_grid(name);
}

}  // namespace

std::vector<RasterFile> RasterUnpacker::find_rasters(const std::filesystem::path& file) {
  std::error_code ignored;
  const std::string path = file.string();
  if (!std::filesystem::exists(file, ignored)) throw Error(path, "does not exist");
  if (std::filesystem::is_directory(file, ignored))
    throw Error(path, "is a folder: name the rasters in it");
  const city::FileContents contents = city::list_contents(file, any_ending);
  const city::Document& first = contents.documents.front();
  const bool is_in_other_form =
      is_named_as_gsi_grid(path) || (is_named_as_text_raster(path) && is_to_be_straightened(first));
  if (!first.packed && !is_in_other_form) return {{path, path, nullptr}};
  gdal::register_drivers();
  const gdal::Guard guard;
  ++inputs_;
  if (!files_) files_ = std::make_shared<gdal::ScratchFiles>(scratch_folder());
  if (first.name != path) return unpack_archive(path, contents);
  return {copy_alone(file, first)};
}

// Texts are heights where nothing else is: beside rasters they are licences and lists of tiles.
std::vector<RasterFile> RasterUnpacker::unpack_archive(const std::string& path,
                                                       const city::FileContents& contents) {
  std::vector<Entry> entries;
  for (const city::Document& document : contents.documents)
    entries.push_back(
        {document.name, document.name.substr(path.size() + 1), document.open_as_it_is});
  const auto is_raster = [](const Entry& entry) { return is_raster_name(entry.name); };
  const bool takes_texts = std::none_of(entries.begin(), entries.end(), is_raster);
  std::vector<const Entry*> rasters, passed_over, archives;
  std::set<std::string> stems;
  for (const Entry& entry : entries) {
    const std::string& name = entry.name;
    if (city::is_named_as_archive(to_lower(name))) archives.push_back(&entry);
    if (!(takes_texts ? is_named_as_text(name) : is_raster_name(name))) continue;
    (is_about_heights(name) ? passed_over : rasters).push_back(&entry);
    if (!is_about_heights(name)) stems.insert(find_stem(name));
  }
  const std::string first = !passed_over.empty() ? passed_over.front()->inside
                            : entries.empty()    ? ""
                                                 : entries.front().inside;
  if (rasters.empty())
    throw NoRaster(path, "the archive holds no elevation model" +
                             (first.empty() ? "" : ", but " + first) +
                             ": unpack it and name what is inside");
  if (!passed_over.empty())
    std::fprintf(stderr,
                 "note: %s: %zu rasters inside were passed over whose names speak of no heights "
                 "(%s): where they are heights, unpack it and name the files\n",
                 path.c_str(), passed_over.size(), first.c_str());
  if (!archives.empty())
    std::fprintf(stderr,
                 "note: %s: %zu archives inside archives in it were passed over (%s): where they "
                 "hold heights, unpack them\n",
                 path.c_str(), archives.size(), archives.front()->inside.c_str());
  for (const Entry& entry : entries)
    if (!is_raster(entry) && is_named_as_companion(entry.name) &&
        stems.contains(find_stem(entry.name)))
      copy(entry);
  return copy_rasters(rasters);
}

std::vector<RasterFile> RasterUnpacker::copy_rasters(const std::vector<const Entry*>& rasters) {
  std::vector<RasterFile> files;
  std::set<std::string> paths;
  for (const Entry* raster : rasters) {
    files.push_back({copy(*raster), raster->name, files_});
    // GDAL would find the later one alone under both names.
    if (!paths.insert(files.back().path).second)
      throw Error(raster->name,
                  "is in the archive more than once: unpack it and name the one that is right");
  }
  return files;
}

RasterFile RasterUnpacker::copy_alone(const std::filesystem::path& file,
                                      const city::Document& document) {
  const std::filesystem::path plain =
      document.packed ? city::without_stream_ending(file.native()) : file.native();
  // These may lie beside, and are plain themselves.
  for (const char* ending : {".prj", ".PRJ", ".hdr", ".HDR", ".tfw", ".TFW"}) {
    std::filesystem::path beside = plain;
    beside.replace_extension(ending);
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(beside, ignored)) continue;
    const city::Document other = city::list_documents(beside, any_ending).front();
    copy({other.name, beside.filename().string(), other.open_as_it_is});
  }
  return {copy({document.name, plain.filename().string(), document.open_as_it_is}), document.name,
          files_};
}

std::string RasterUnpacker::copy(const Entry& entry) {
  if (is_named_as_gsi_grid(entry.inside)) return copy_gsi_grid(entry);
  auto source = entry.open();
  if (is_named_as_text_raster(entry.inside)) source = straighten_text(std::move(source));
  return add(entry.inside, entry.name, *source);
}

std::string RasterUnpacker::copy_gsi_grid(const Entry& entry) {
  constexpr std::size_t most_bytes = std::size_t{1} << 28;  // a tile has some MB
  const GsiGrid grid =
      read_gsi_grid(city::read_next(*city::to_utf8(entry.open()), most_bytes), entry.name);
  const std::string stem = entry.inside.substr(0, entry.inside.rfind('.'));
  OGRSpatialReference crs;
  char* text = nullptr;
  if (crs.SetFromUserInput(grid.crs.c_str()) == OGRERR_NONE) crs.exportToWkt(&text);
  add(stem + ".prj", entry.name, *city::resume(text ? text : "", nullptr));
  CPLFree(text);
  return add(stem + ".asc", entry.name, *city::resume(grid.grid, nullptr));
}

std::string RasterUnpacker::add(const std::string& inside, const std::string& name,
                                city::ByteSource& source) {
  return files_->add(std::to_string(inputs_) + "/" + inside, [&](char* out, std::size_t size) {
    const std::size_t got = source.read(out, size);
    count(got, name);
    return got;
  });
}

void RasterUnpacker::count(std::size_t bytes, const std::string& name) {
  constexpr std::uint64_t megabyte = 1'000'000;
  unpacked_ += bytes;
  if (unpacked_ > static_cast<std::uint64_t>(max_mb_) * megabyte)
    throw Error(name, "elevation models unpack to more than max_dem_unpacked_mb in [terrain] = " +
                          std::to_string(max_mb_) +
                          ": raise it where the temporary folder has room, or name those alone "
                          "that cover the city");
}

bool holds_packed_rasters(const std::filesystem::path& file) {
  const city::FileContents contents = city::list_contents(file, any_ending);
  return std::any_of(
      contents.documents.begin(), contents.documents.end(), [](const city::Document& document) {
        return document.packed &&
               is_raster_name(std::string(city::without_stream_ending(document.name)));
      });
}

}  // namespace nightcity::terrain
