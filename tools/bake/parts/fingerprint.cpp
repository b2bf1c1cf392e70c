#include "tools/bake/parts/fingerprint.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "formats/checksum.h"
#include "formats/error.h"

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

}  // namespace

std::string make_fingerprint(const CityInputs& inputs, const std::string& version) {
  const fs::path folder = fs::absolute(inputs.recipe).lexically_normal().parent_path();
  std::string text = "nightbake " + version + "\n";
  for (const auto* files : {&inputs.files, &inputs.maps, &inputs.ground.elevation_models}) {
    for (const fs::path& file : *files) text += describe(file, folder);
    text += "\n";
  }
  text += read_text(inputs.recipe);
  return fmt::format("{:016x}", checksum(text.data(), text.size()));
}

}  // namespace nightcity::bake
