// A disk that is full, for tests: files of this process that may not grow.
#pragma once

#include <signal.h>
#include <sys/resource.h>

namespace nightcity::test {

/// As long as it lives, writes beyond `bytes` of a file fail.
class FileLimit {
 public:
  explicit FileLimit(rlim_t bytes) {
    ::signal(SIGXFSZ, SIG_IGN);  // which would end the process before a write can fail
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }
  FileLimit(const FileLimit&) = delete;
  FileLimit& operator=(const FileLimit&) = delete;

 private:
  rlimit before_{};
};

}  // namespace nightcity::test
