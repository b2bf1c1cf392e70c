#include "tools/inputs/named_once.h"

#include <algorithm>
#include <string>
#include <unordered_set>
#include <utility>

namespace nightcity::inputs {
namespace {

namespace fs = std::filesystem;

std::string to_normal_name(const fs::path& file) {
  const fs::path normal = file.lexically_normal();
  return normal.has_filename() ? normal.string() : normal.parent_path().string();
}

}  // namespace

NamedOnce name_once(std::vector<fs::path> files, Mention kept) {
  NamedOnce once;
  std::unordered_set<std::string> names;
  if (kept == Mention::last) std::reverse(files.begin(), files.end());
  for (fs::path& file : files) {
    if (names.insert(to_normal_name(file)).second) {
      once.files.push_back(std::move(file));
      continue;
    }
    if (once.repeats++ == 0) once.first_repeat = std::move(file);
  }
  if (kept == Mention::last) std::reverse(once.files.begin(), once.files.end());
  return once;
}

}  // namespace nightcity::inputs
