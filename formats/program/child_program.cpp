#include "formats/program/child_program.h"

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "formats/error.h"

namespace nightcity::program {
namespace {

constexpr int no_such_program = 127;  // as shells say it

// In the child, where other threads of the parent may have held locks: system calls alone.
[[noreturn]] void become(char* const* words, int output, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(no_such_program);  // it ended before that was heeded
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  if (output >= 0 && ::dup2(output, 1) < 0) ::_exit(126);
  ::execvp(words[0], words);
  ::_exit(errno == ENOENT ? no_such_program : 126);
}

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 1 << 16> piece;
  ::lseek(descriptor, 0, SEEK_SET);
  for (ssize_t got; (got = ::read(descriptor, piece.data(), piece.size())) > 0;)
    text.append(piece.data(), static_cast<std::size_t>(got));
  return text;
}

}  // namespace

std::optional<ChildResult> run_child(const std::vector<std::string>& words, bool keep_output) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  const auto refuse = [&](int error) {
    throw Error(words.at(0), std::string("cannot be run: ") + std::strerror(error));
  };
  const int output = keep_output ? ::memfd_create("output", MFD_CLOEXEC) : -1;
  if (keep_output && output < 0) refuse(errno);
  const pid_t parent = ::getpid(), child = ::fork();
  if (child == 0) become(pointers.data(), output, parent);
  int status = 0;
  bool ended = child > 0;
  while (ended && ::waitpid(child, &status, 0) != child) ended = errno == EINTR;
  const int error = errno;
  ChildResult result{status, ended && keep_output ? read_all(output) : ""};
  if (output >= 0) ::close(output);
  if (!ended) refuse(error);
  if (WIFEXITED(status) && WEXITSTATUS(status) == no_such_program) return {};
  return result;
}

}  // namespace nightcity::program
