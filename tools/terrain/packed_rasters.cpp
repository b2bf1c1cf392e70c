#include "tools/terrain/packed_rasters.h"

#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <set>
#include <string_view>
#include <utility>

#include "formats/error.h"
#include "formats/file_names.h"
#include "formats/to_lower.h"
#include "tools/gdal/guarded_gdal.h"
#include "tools/gdal/scratch_files.h"
#include "tools/terrain/raster_names.h"

namespace nightcity::terrain {
namespace {

constexpr std::array<std::string_view, 1> any_ending{""};
constexpr std::string_view gzip = ".gz";

bool is_gzip(std::string_view name) {
  return to_lower(name).ends_with(gzip);
}

std::string without_gzip(std::string_view name) {
  return std::string(name.substr(0, name.size() - (is_gzip(name) ? gzip.size() : 0)));
}

// Returns a name with its folders but without what stands behind its first point, in lower case:
// "a.tif", "a.tfw" and "a.tif.aux.xml" belong together.
std::string find_stem(std::string_view name) {
  const std::size_t folders = name.find_last_of("/\\") + 1;  // npos + 1 is 0
  return to_lower(name.substr(0, name.find('.', folders)));
}

// The entries of an archive by their part in it.
struct Entries {
  std::vector<const city::Document*> rasters, companions;
  std::size_t passed_over = 0;  // rasters that hold something else
  std::string first_passed_over;
};

// Texts are heights where nothing else is: beside rasters they are licences and lists of tiles.
Entries sort_entries(const std::vector<city::Document>& documents) {
  const auto is_raster = [](const city::Document& document) {
    return is_named_as_raster(without_gzip(document.name));
  };
  const bool takes_texts = std::none_of(documents.begin(), documents.end(), is_raster);
  Entries entries;
  std::set<std::string> stems;
  for (const city::Document& document : documents) {
    const std::string name = without_gzip(document.name);
    if (!(takes_texts ? is_named_as_text(name) : is_named_as_raster(name))) continue;
    if (!is_about_heights(name))
      entries.rasters.push_back(&document), stems.insert(find_stem(document.name));
    else if (entries.passed_over++ == 0)
      entries.first_passed_over = document.name;
  }
  for (const city::Document& document : documents)
    if (!is_raster(document) && stems.contains(find_stem(document.name)) &&
        !(takes_texts && is_named_as_text(without_gzip(document.name))))
      entries.companions.push_back(&document);
  return entries;
}

}  // namespace

std::vector<RasterFile> RasterUnpacker::find_rasters(const std::filesystem::path& file) {
  std::error_code ignored;
  const std::string path = file.string();
  if (!std::filesystem::exists(file, ignored)) throw Error(path, "does not exist");
  if (std::filesystem::is_directory(file, ignored))
    throw Error(path, "is a folder: name the rasters in it");
  const city::FileContents contents = city::list_contents(file, any_ending);
  if (!contents.documents.front().packed) return {{path, path, nullptr}};
  gdal::register_drivers();
  ++inputs_;
  if (!files_) files_ = std::make_shared<gdal::ScratchFiles>(scratch_folder());
  if (contents.documents.front().name != path) return unpack_archive(path, contents);
  return {unpack_gzip(file, contents.documents.front())};
}

std::vector<RasterFile> RasterUnpacker::unpack_archive(const std::string& path,
                                                       const city::FileContents& contents) {
  const Entries entries = sort_entries(contents.documents);
  if (entries.rasters.empty()) {
    const bool is_packed = !contents.packed_entries.empty();
    throw NoRaster(path, "the archive holds no elevation model, but " +
                             (is_packed ? "another packed file (" + contents.packed_entries.front()
                                        : contents.documents.front().name) +
                             (is_packed ? ")" : "") + ": unpack it and name what is inside");
  }
  if (entries.passed_over > 0)
    std::fprintf(stderr,
                 "note: %s: %zu rasters inside were passed over whose names speak of no heights "
                 "(%s)\n",
                 path.c_str(), entries.passed_over, entries.first_passed_over.c_str());
  const auto name_inside = [&](const city::Document& document) {
    return without_gzip(std::string_view(document.name).substr(path.size() + 1));
  };
  for (const city::Document* document : entries.companions)
    unpack(*document, name_inside(*document));
  std::vector<RasterFile> files;
  for (const city::Document* document : entries.rasters)
    files.push_back({is_gzip(document->name)
                         ? unpack_gzip_in_archive(*document, name_inside(*document))
                         : unpack(*document, name_inside(*document)),
                     document->name, files_});
  return files;
}

RasterFile RasterUnpacker::unpack_gzip(const std::filesystem::path& file,
                                       const city::Document& document) {
  const std::filesystem::path plain = without_gzip(file.string());
  // Of what may lie beside, plain itself.
  for (const char* ending : {".prj", ".PRJ", ".hdr", ".HDR", ".tfw", ".TFW"}) {
    std::filesystem::path beside = plain;
    beside.replace_extension(ending);
    std::error_code ignored;
    if (std::filesystem::is_regular_file(beside, ignored))
      unpack(city::list_documents(beside, any_ending).front(), beside.filename().string());
  }
  return {unpack(document, plain.filename().string()), document.name, files_};
}

std::string RasterUnpacker::unpack(const city::Document& document, const std::string& name) {
  const auto source = document.open_as_it_is();
  return files_->add(std::to_string(inputs_) + "/" + name, [&](char* out, std::size_t size) {
    const std::size_t got = source->read(out, size);
    count(got, document.name);
    return got;
  });
}

// GDAL reads a gzip stream from its beginning for each step back, so that it is unpacked once more.
std::string RasterUnpacker::unpack_gzip_in_archive(const city::Document& document,
                                                   const std::string& name) {
  const gdal::Guard guard;
  const std::string packed = unpack(document, name + std::string(gzip));
  const std::unique_ptr<VSILFILE, int (*)(VSILFILE*)> source(
      VSIFOpenL(("/vsigzip/" + packed).c_str(), "rb"), VSIFCloseL);
  if (!source) throw Error(document.name, "broken gzip stream: " + gdal::find_reason());
  CPLErrorReset();
  const std::string path =
      files_->add(std::to_string(inputs_) + "/" + name, [&](char* out, std::size_t size) {
        const std::size_t got = VSIFReadL(out, 1, size, source.get());
        count(got, document.name);
        return got;
      });
  if (CPLGetLastErrorType() == CE_Failure)
    throw Error(document.name, "broken gzip stream: " + gdal::find_reason());
  return path;
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
  return std::any_of(contents.documents.begin(), contents.documents.end(),
                     [](const city::Document& document) {
                       return document.packed && is_named_as_raster(without_gzip(document.name));
                     });
}

}  // namespace nightcity::terrain
