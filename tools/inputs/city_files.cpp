#include "tools/inputs/city_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "tools/city/byte_source.h"
#include "tools/inputs/file_format.h"

namespace nightcity::inputs {
namespace {

namespace fs = std::filesystem;

bool is_city_file(const fs::path& path) {
  const std::string name = to_lower(path.filename().string());
  if (name.ends_with(".zip")) return true;
  const std::string_view plain = std::string_view(name).substr(
      0, name.size() - (name.ends_with(".gz") ? std::string_view(".gz").size() : 0));
  return city::ends_with_any(plain, city_endings());
}

bool holds_city_file(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    std::error_code unknown;
    if (entry->is_regular_file(unknown) && is_city_file(entry->path())) return true;
  }
  return false;
}

// Metadata and code lists lie beside cities under the same endings.
std::vector<fs::path> leave_out_others(const fs::path& folder, const std::vector<fs::path>& found) {
  std::vector<fs::path> files;
  std::string first_reason;
  for (const fs::path& file : found) {
    const std::string reason = find_reason_to_pass_over(file);
    if (reason.empty()) {
      files.push_back(file);
      continue;
    }
    if (first_reason.empty()) first_reason = file.filename().string() + " " + reason;
    fmt::print(stderr, "note: {}: passed over: it {}\n", file.string(), reason);
  }
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
  std::vector<fs::path> not_entered;
  bool folders = false;
  fs::directory_iterator entry(path, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code unknown;  // a dangling link is no file
    folders |= entry->is_directory(unknown);
    if (entry->is_directory(unknown) && holds_city_file(entry->path()))
      not_entered.push_back(entry->path());
    if (entry->is_regular_file(unknown) && is_city_file(entry->path()))
      found.push_back(entry->path());
  }
  if (error) throw Error(path.string(), "the folder cannot be read: " + error.message());
  if (found.empty())
    throw Error(path.string(),
                "no " + city::join_endings(city_endings()) + " (also .gz) or .zip in this folder" +
                    (folders ? "; folders inside it are not entered: name them" : ""));
  std::sort(found.begin(), found.end());
  std::sort(not_entered.begin(), not_entered.end());
  for (const fs::path& folder : not_entered)
    fmt::print(stderr, "note: {}: folders inside a folder are not entered: name it\n",
               folder.string());
  return leave_out_others(path, found);
}

}  // namespace nightcity::inputs
