#include "tools/survey/archive_uses.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "formats/error.h"
#include "formats/file_names.h"
#include "formats/to_lower.h"
#include "tools/city/byte_source.h"
#include "tools/inputs/file_format.h"
#include "tools/survey/looks.h"
#include "tools/terrain/packed_rasters.h"

namespace nightcity::survey {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 8> table_endings{".csv", ".tsv",  ".geojson", ".geojsonl",
                                                        ".shp", ".gpkg", ".fgb",     ".json"};
constexpr std::array<std::string_view, 4> raster_endings{".tif", ".tiff", ".asc", ".xyz"};
constexpr std::array<std::string_view, 6> other_endings{".pbf", ".osm", ".ies",
                                                        ".ldt", ".gml", ".obj"};

// The contents of an archive that looks have found a use for.
struct Taken {
  std::set<inputs::FileKind> kinds;
  bool tables = false, rasters = false;
};

bool is_useful(std::string_view ending, const Taken& taken) {
  return (!taken.tables && city::ends_with_any(ending, table_endings)) ||
         (!taken.rasters && city::ends_with_any(ending, raster_endings)) ||
         city::ends_with_any(ending, other_endings);
}

std::string list_unread(const fs::path& path, const Taken& taken) {
  city::FileContents contents;
  try {
    contents = inputs::list_readable(path);
  } catch (const city::NothingInside&) {  // tables and heights alone
    return {};
  }
  std::string unread;
  const auto add = [&](const std::string& what) { unread += (unread.empty() ? "" : ", ") + what; };
  for (const city::Document& document : contents.documents) {
    const inputs::FileFormat* format = inputs::find_format(document);
    if (format && !taken.kinds.contains(format->kind))
      add(fs::path(document.name).filename().string() + " (" + format->name + ")");
  }
  for (const auto& [ending, count] : contents.others)
    if (is_useful(ending, taken)) add(fmt::format("{} {}", count, ending));
  return unread;
}

void tell(SurveyedFile& file, const Taken& taken) {
  if (const std::string unread = list_unread(file.path, taken); !unread.empty())
    file.what += "; unpack it for what else it holds: " + unread;
}

bool holds_table(const fs::path& path) {
  constexpr std::array<std::string_view, 1> any_ending{""};
  for (const city::Document& document : city::list_contents(path, any_ending).documents)
    if (document.name != path && city::ends_with_any(to_lower(document.name), table_endings))
      return true;
  return false;
}

// Returns the formats that its documents have, each once.
std::vector<const inputs::FileFormat*> find_formats(const fs::path& path) {
  std::vector<const inputs::FileFormat*> formats;
  try {
    for (const city::Document& document : inputs::list_readable(path).documents) {
      if (document.name == path) return {};  // it is no archive
      const inputs::FileFormat* format = inputs::find_format(document);
      if (format && std::none_of(formats.begin(), formats.end(),
                                 [&](const auto* known) { return known->kind == format->kind; }))
        formats.push_back(format);
    }
  } catch (const city::NothingInside&) {
  }
  return formats;
}

}  // namespace

std::vector<SurveyedFile> find_archive_uses(const fs::path& path) {
  std::vector<SurveyedFile> uses;
  Taken taken;
  const auto attempt = [&](const auto& look) {
    SurveyedFile file;
    file.path = path;
    try {
      look(file);
    } catch (const Error&) {  // another look may find more
      return false;
    }
    if (file.use == Use::nothing) return false;
    uses.push_back(std::move(file));
    return true;
  };
  try {
    const std::vector<const inputs::FileFormat*> formats = find_formats(path);
    const bool has_rasters = is_archive_of_rasters(path), has_table = holds_table(path);
    if (formats.size() + has_rasters + has_table < 2) return {};
    for (const inputs::FileFormat* format : formats) {
      const bool is_city = format->kind == inputs::FileKind::city;
      if (!is_city && format->kind != inputs::FileKind::osm) continue;
      if (attempt([&](SurveyedFile& file) {
            is_city ? look_at_city(file, format->name) : look_at_map(file);
          }))
        taken.kinds.insert(format->kind);
    }
    taken.rasters = has_rasters && attempt(look_at_raster);
    taken.tables = has_table && attempt(look_at_table);
  } catch (const Error&) {  // broken, as the attempts to read it say
    return {};
  }
  if (uses.size() < 2) return {};
  tell(uses.front(), taken);
  return uses;
}

void tell_unread(SurveyedFile& file, inputs::FileKind read) {
  tell(file, {{read}, false, false});
}

bool is_archive_of_rasters(const fs::path& path) {
  try {
    return terrain::holds_packed_rasters(path);
  } catch (const Error&) {
    return false;  // broken, as the attempts to read it say
  }
}

}  // namespace nightcity::survey
