#include "tools/bake/city/city_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

#include "formats/error.h"

namespace nightcity {
namespace {

namespace fs = std::filesystem;

bool is_city_file(const fs::path& path) {
  std::string name = path.filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<std::string_view, 7> endings{".gml",    ".xml",        ".citygml", ".gml.gz",
                                                    ".xml.gz", ".citygml.gz", ".zip"};
  return std::any_of(endings.begin(), endings.end(),
                     [&](std::string_view e) { return name.ends_with(e); });
}

}  // namespace

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
                std::string("no .gml, .xml, .citygml (also .gz) or .zip in this folder") +
                    (folders ? "; folders inside it are not entered: name them" : ""));
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace nightcity
