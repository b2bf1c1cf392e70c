#include "tools/bake/parts/fingerprint.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <map>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "formats/checksum.h"
#include "formats/error.h"
#include "formats/to_lower.h"

namespace nightcity::bake {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(path.string(), "cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

// The time counts from the clock's own epoch: it is only ever compared with itself.
std::string describe(const fs::path& file, const fs::path& folder) {
  std::error_code error;
  const auto size = fs::file_size(file, error);
  const auto time = error ? fs::file_time_type() : fs::last_write_time(file, error);
  if (error) throw Error(file.string(), "cannot be read: " + error.message());
  return fmt::format("{} {} {}\n",
                     fs::absolute(file).lexically_normal().lexically_relative(folder).string(),
                     size, time.time_since_epoch().count());
}

bool has_ending(const fs::path& file, std::initializer_list<const char*> endings) {
  const std::string own = to_lower(file.extension().string());
  return std::any_of(endings.begin(), endings.end(), [&](const char* one) { return own == one; });
}

// Returns the files that the city's own may name and that lie beside them or below: pictures where
// these are read, and libraries of colours of Wavefront OBJ. In order, each once.
std::set<fs::path> list_named_files(const CityInputs& inputs) {
  const bool pictures = inputs.read.textures != city::Textures::none;
  std::map<fs::path, bool> folders;  // whether one has an OBJ
  for (const fs::path& file : inputs.files)
    folders[fs::absolute(file).lexically_normal().parent_path()] |= has_ending(file, {".obj"});
  std::set<fs::path> files;
  for (const auto& [folder, libraries] : folders) {
    if (!pictures && !libraries) continue;
    std::error_code error;
    constexpr auto options = fs::directory_options::skip_permission_denied;
    for (fs::recursive_directory_iterator entry(folder, options, error), end;
         !error && entry != end; entry.increment(error)) {
      const fs::path& file = entry->path();
      const bool is_wanted =
          (pictures && has_ending(file, {".png", ".jpg", ".jpeg", ".jpe", ".jfif"})) ||
          (libraries && has_ending(file, {".mtl"}));
      std::error_code unused;
      if (is_wanted && entry->is_regular_file(unused)) files.insert(file);
    }
  }
  return files;
}

}  // namespace

std::string make_fingerprint(const CityInputs& inputs, const std::string& version) {
  const fs::path folder = fs::absolute(inputs.recipe).lexically_normal().parent_path();
  std::string text = "nightbake " + version + "\n";
  for (const auto* files : {&inputs.files, &inputs.maps, &inputs.ground.elevation_models}) {
    for (const fs::path& file : *files) text += describe(file, folder);
    text += "\n";
  }
  for (const fs::path& file : list_named_files(inputs)) text += describe(file, folder);
  text += "\n" + read_text(inputs.recipe);
  return fmt::format("{:016x}", checksum(text.data(), text.size()));
}

}  // namespace nightcity::bake
