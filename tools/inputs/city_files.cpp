#include "tools/inputs/city_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <utility>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "tools/city/byte_source.h"
#include "tools/city/packing.h"
#include "tools/inputs/file_format.h"

namespace nightcity::inputs {
namespace {

namespace fs = std::filesystem;

bool is_city_file(const fs::path& path) {
  const std::string name = to_lower(path.filename().string());
  return city::is_named_as_archive(name) || city::is_named_as_volume(name) ||
         city::ends_with_any(city::without_stream_ending(name), city_endings());
}

bool is_hidden(const fs::path& path) {
  return path.filename().string().starts_with('.');
}

// Metadata and code lists lie beside cities under the same endings.
std::vector<fs::path> leave_out_others(const fs::path& folder, const std::vector<fs::path>& found) {
  std::vector<fs::path> files;
  std::string first_reason;
  // By folder and reason: a delivery may hold hundreds of code lists.
  std::map<std::pair<fs::path, std::string>, std::vector<fs::path>> passed_over;
  for (const fs::path& file : found) {
    const std::string reason = find_reason_to_pass_over(file);
    if (reason.empty()) {
      files.push_back(file);
      continue;
    }
    if (first_reason.empty()) first_reason = file.filename().string() + " " + reason;
    passed_over[{file.parent_path(), reason}].push_back(file);
  }
  for (const auto& [what, others] : passed_over)
    fmt::print(stderr, "note: {}: passed over{}: it {}\n", others.front().string(),
               others.size() == 1 ? "" : fmt::format(", and {} files beside it", others.size() - 1),
               what.second);
  if (files.empty()) throw Error(folder.string(), "no city model in this folder: " + first_reason);
  return files;
}

}  // namespace

std::vector<std::string_view> city_endings() {
  std::vector<std::string_view> endings;
  for (const FileFormat& format : file_formats())
    endings.insert(endings.end(), format.endings.begin(), format.endings.end());
  return endings;
}

std::vector<fs::path> city_files(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return {path};
  std::vector<fs::path> found;
  fs::recursive_directory_iterator entry(path, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    std::error_code unknown;  // a dangling link is no file
    if (is_hidden(entry->path())) {
      entry.disable_recursion_pending();
    } else if (entry->is_regular_file(unknown) && is_city_file(entry->path())) {
      found.push_back(entry->path());
    }
  }
  if (error) throw Error(path.string(), "the folder cannot be read: " + error.message());
  if (found.empty())
    throw Error(path.string(),
                "no " + city::join_endings(city_endings()) +
                    " (also .gz, .xz, ...) or archive in this folder and those inside it");
  std::sort(found.begin(), found.end());
  return leave_out_others(path, found);
}

}  // namespace nightcity::inputs
