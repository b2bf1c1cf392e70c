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
[[noreturn]] void become(char* const* words, int output, int messages, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(no_such_program);  // it ended before that was heeded
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  if (output >= 0 && ::dup2(output, 1) < 0) ::_exit(126);
  if (messages >= 0 && ::dup2(messages, 2) < 0) ::_exit(126);
  ::execvp(words[0], words);
  ::_exit(errno == ENOENT ? no_such_program : 126);
}

// Leaves the place alone at which a child that shares the descriptor goes on writing.
std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 1 << 16> piece;
  for (ssize_t got; (got = ::pread(descriptor, piece.data(), piece.size(),
                                   static_cast<off_t>(text.size()))) > 0;)
    text.append(piece.data(), static_cast<std::size_t>(got));
  return text;
}

[[noreturn]] void refuse(const std::string& program, int error) {
  throw Error(program, std::string("cannot be run: ") + std::strerror(error));
}

// Returns a file in memory.
int open_memory(const std::string& program) {
  const int file = ::memfd_create("output", MFD_CLOEXEC);
  if (file < 0) refuse(program, errno);
  return file;
}

// Returns a new process of that program; -1 with errno where there is none. Streams of -1 are those
// of this program.
pid_t start(const std::vector<std::string>& words, int output, int messages) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  const pid_t parent = ::getpid(), child = ::fork();
  if (child == 0) become(pointers.data(), output, messages, parent);
  return child;
}

}  // namespace

std::optional<ChildResult> run_child(const std::vector<std::string>& words, bool keep_output) {
  const int output = keep_output ? open_memory(words.at(0)) : -1;
  const pid_t child = start(words, output, -1);
  int status = 0;
  bool ended = child > 0;
  while (ended && ::waitpid(child, &status, 0) != child) ended = errno == EINTR;
  const int error = errno;
  ChildResult result{status, ended && keep_output ? read_all(output) : ""};
  if (output >= 0) ::close(output);
  if (!ended) refuse(words.at(0), error);
  if (WIFEXITED(status) && WEXITSTATUS(status) == no_such_program) return {};
  return result;
}

ChildProgram::ChildProgram(const std::vector<std::string>& words)
    : output_(open_memory(words.at(0))), messages_(open_memory(words.at(0))) {
  child_ = start(words, output_, messages_);
  if (child_ > 0) return;
  const int error = errno;
  ::close(output_);
  ::close(messages_);
  refuse(words.at(0), error);
}

ChildProgram::~ChildProgram() {
  stop();
  while (!status_ && ::waitpid(child_, nullptr, 0) != child_ && errno == EINTR) {
  }
  ::close(output_);
  ::close(messages_);
}

void ChildProgram::stop() {
  if (!status_) ::kill(child_, SIGTERM);
}

std::optional<int> ChildProgram::find_status() {
  int status = 0;
  if (!status_ && ::waitpid(child_, &status, WNOHANG) == child_) status_ = status;
  return status_;
}

std::string ChildProgram::read_output() const {
  return read_all(output_);
}

std::string ChildProgram::read_messages() const {
  return read_all(messages_);
}

}  // namespace nightcity::program
