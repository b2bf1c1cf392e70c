#include "formats/program/toml_file.h"

#include "formats/error.h"
#include "formats/program/nearest_word.h"
#include "formats/program/toml_depth.h"
#include "formats/small_file.h"

namespace nightcity::program {

toml::table read_toml(const std::filesystem::path& path) {
  const std::string text = read_small_file(path);
  constexpr std::size_t max_key_parts = 32;
  if (const auto line = find_deep_key(text, max_key_parts))
    throw Error(path.string(), *line,
                "a key has more than " + std::to_string(max_key_parts) + " parts");
  try {
    return toml::parse(text, path.string());
  } catch (const toml::parse_error& error) {
    throw Error(path.string(), error.source().begin.line,
                "is not TOML: " + std::string(error.description()));
  }
}

void refuse_unknown_key(const std::string& file, const toml::key& key, const std::string& what,
                        const std::vector<std::string>& known) {
  std::string message = "unknown " + what;
  const std::string nearest = find_nearest_word(std::string(key.str()), known);
  if (!nearest.empty()) message += "; did you mean \"" + nearest + "\"?";
  throw UsageError(file, key.source().begin.line, message);
}

}  // namespace nightcity::program
