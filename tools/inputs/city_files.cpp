#include "tools/inputs/city_files.h"

#include <algorithm>

#include "formats/error.h"
#include "tools/city/byte_source.h"
#include "tools/inputs/file_format.h"

namespace nightcity::inputs {
namespace {

namespace fs = std::filesystem;

bool is_city_file(const fs::path& path) {
  const std::string name = city::to_lower(path.filename().string());
  if (name.ends_with(".zip")) return true;
  const std::string_view plain = std::string_view(name).substr(
      0, name.size() - (name.ends_with(".gz") ? std::string_view(".gz").size() : 0));
  return city::ends_with_any(plain, city_endings());
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
  bool folders = false;
  fs::directory_iterator entry(path, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code unknown;  // a dangling link is no file
    folders |= entry->is_directory(unknown);
    if (entry->is_regular_file(unknown) && is_city_file(entry->path()))
      found.push_back(entry->path());
  }
  if (error) throw Error(path.string(), "the folder cannot be read: " + error.message());
  if (found.empty())
    throw Error(path.string(),
                "no " + city::join_endings(city_endings()) + " (also .gz) or .zip in this folder" +
                    (folders ? "; folders inside it are not entered: name them" : ""));
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace nightcity::inputs
