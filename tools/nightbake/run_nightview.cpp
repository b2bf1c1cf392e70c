#include "tools/nightbake/run_nightview.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <fstream>

#include "formats/error.h"

extern char** environ;

namespace nightcity::nightbake {
namespace {

// Returns the exit status, or nothing where there is no such program.
std::optional<int> run(const std::filesystem::path& program,
                       const std::vector<std::string>& arguments,
                       const std::filesystem::path& output) {
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, 1, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                     0644);
  pid_t child = 0;
  const int failed =
      ::posix_spawnp(&child, pointers[0], &actions, nullptr, pointers.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failed == ENOENT) return {};
  int status = 0;
  if (failed != 0 || ::waitpid(child, &status, 0) != child)
    throw Error(program.string(), "cannot be run");
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127) return {};
  return status;
}

}  // namespace

std::filesystem::path find_nightview() {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path beside = self.parent_path() / "nightview";
  return !error && std::filesystem::exists(beside, error) ? beside
                                                          : std::filesystem::path("nightview");
}

std::optional<nlohmann::json> run_nightview(const std::filesystem::path& program,
                                            const std::vector<std::string>& arguments,
                                            const std::filesystem::path& scratch) {
  const std::optional<int> status = run(program, arguments, scratch);
  nlohmann::json result;
  if (status == 0) {
    std::ifstream file(scratch);
    result = nlohmann::json::parse(file, nullptr, false);
  }
  std::error_code ignored;
  std::filesystem::remove(scratch, ignored);
  if (!status) return {};
  if (*status != 0)
    throw Error(program.string(), "failed, and said why above; the bakes are there");
  if (result.is_discarded()) throw Error(program.string(), "printed something that is no JSON");
  return result;
}

}  // namespace nightcity::nightbake
