#include "tools/survey/survey.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "tools/city/archive_entries.h"
#include "tools/city/byte_source.h"
#include "tools/city/text_encoding.h"
#include "tools/inputs/file_format.h"
#include "tools/inventory/look_at_table.h"
#include "tools/survey/archive_uses.h"
#include "tools/survey/looks.h"
#include "tools/survey/place_tables.h"
#include "tools/terrain/elevation_model.h"

namespace nightcity::survey {
namespace {

namespace fs = std::filesystem;

// Endings of files that belong to others.
constexpr std::array<std::string_view, 20> companion_endings{
    ".mtl", ".png", ".jpg", ".jpeg", ".dbf", ".shx", ".prj",  ".cpg", ".qix", ".qmd",
    ".sbn", ".sbx", ".tfw", ".aux",  ".md",  ".pdf", ".toml", ".xsd", ".bin", ".ktx2"};

bool is_companion(const fs::path& file) {
  const std::string ending = to_lower(file.extension().string());
  return std::find(companion_endings.begin(), companion_endings.end(), ending) !=
         companion_endings.end();
}

void look_at_format(SurveyedFile& file) {
  const inputs::FileFormat& format = inputs::find_format(file.path);
  switch (format.kind) {
    case inputs::FileKind::city:
      look_at_city(file, format.name);
      return tell_unread(file, format.kind);
    case inputs::FileKind::osm:
      look_at_map(file);
      return tell_unread(file, format.kind);
    case inputs::FileKind::luminaire:
      return look_at_luminaire(file, format.name);
    case inputs::FileKind::scene:
    case inputs::FileKind::lights:
      file.what = std::string(format.name) +
                  ": a finished scene, not what one is made from; a model is exported as Wavefront "
                  "OBJ (Blender does)";
  }
}

SurveyedFile look_at(const fs::path& path) {
  SurveyedFile file;
  file.path = path;
  std::string why;
  bool is_table = true;  // or broken, and not of another kind
  const auto attempt = [&](const auto& look) {
    try {
      look(file);
      return true;
    } catch (const inventory::NoTable& error) {
      is_table = false;
      if (why.empty()) why = error.what();
      return false;
    } catch (const Error& error) {
      if (why.empty()) why = error.what();
      return false;
    }
  };
  if (is_companion(path)) {
    file.use = Use::companion;
    return file;
  }
  if (city::to_valid_utf8(path.string()) != path.string()) {
    file.what = "its name is not in UTF-8, as a recipe is: rename it";
    return file;
  }
  if (attempt(look_at_format)) return file;
  // Texts are heights, a table or, mostly, words for a reader.
  if (to_lower(path.extension().string()) == ".txt") {
    if (attempt(look_at_raster) || (attempt(look_at_table) && file.use == Use::inventory))
      return file;
    file = {};
    file.path = path;
    file.use = Use::companion;
    return file;
  }
  // An archive of an elevation model may hold a table of its tiles, too.
  if (is_archive_of_rasters(path)) {
    const std::string as_other = std::exchange(why, {});
    if (attempt(look_at_raster)) return file;
    if (why.empty()) why = as_other;
  }
  if (inventory::may_be_table(path)) {
    const std::string as_other = std::exchange(why, {});
    if (attempt(look_at_table)) return file;
    // The words for what a table lacks say more than that it is no city model; but JSON and
    // archives may be anything.
    constexpr std::array<std::string_view, 4> of_all_kinds{".json", ".jsonl", ".ndjson", ".shz"};
    if (!is_table && (city::ends_with_any(to_lower(path.string()), of_all_kinds) ||
                      city::find_packing_of(path) != city::Packing::none))
      why = as_other;
  }
  try {
    look_at_raster(file);
    return file;
  } catch (const terrain::NoRaster&) {  // it has been said what it is
  } catch (const Error& error) {        // a raster that holds no heights, unless it is a table
    if (why.empty() || !inventory::may_be_table(path)) why = error.what();
  }
  file.use = Use::nothing;
  const std::string prefix = path.string() + ": ";
  file.what = why.starts_with(prefix) ? why.substr(prefix.size()) : why;
  return file;
}

bool is_hidden(const fs::path& path) {
  return path.filename().string().starts_with('.');
}

void list_files(const fs::path& path, std::set<fs::path>& files) {
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    if (!fs::exists(path, error)) throw Error(path.string(), "is not there");
    files.insert(path);
    return;
  }
  fs::recursive_directory_iterator entry(path, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    std::error_code unknown;
    if (is_hidden(entry->path()))
      entry.disable_recursion_pending();
    else if (entry->is_regular_file(unknown))
      files.insert(entry->path());
  }
  if (error) throw Error(path.string(), "the folder cannot be read: " + error.message());
}

}  // namespace

std::vector<SurveyedFile> survey_files(const std::vector<fs::path>& paths) {
  std::set<fs::path> files;
  for (const fs::path& path : paths) list_files(path.lexically_normal(), files);
  std::vector<SurveyedFile> result;
  for (const fs::path& file : files) {
    std::vector<SurveyedFile> uses = find_archive_uses(file);
    if (uses.empty()) uses.push_back(look_at(file));
    std::move(uses.begin(), uses.end(), std::back_inserter(result));
  }
  place_tables(result);
  return result;
}

}  // namespace nightcity::survey
