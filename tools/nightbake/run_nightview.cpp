#include "tools/nightbake/run_nightview.h"

#include "formats/error.h"
#include "formats/json_parse.h"
#include "formats/program/child_program.h"

namespace nightcity::nightbake {
std::filesystem::path find_nightview() {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path beside = self.parent_path() / "nightview";
  return !error && std::filesystem::exists(beside, error) ? beside
                                                          : std::filesystem::path("nightview");
}

std::optional<nlohmann::json> run_nightview(const std::filesystem::path& program,
                                            const std::vector<std::string>& arguments) {
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const auto ended = program::run_child(words, true);
  if (!ended) return {};
  if (ended->status != 0)
    throw Error(program.string(), "failed, and said why above; the bakes are there");
  nlohmann::json result = try_parse_json(ended->output);
  if (result.is_discarded()) throw Error(program.string(), "printed something that is no JSON");
  return result;
}

}  // namespace nightcity::nightbake
