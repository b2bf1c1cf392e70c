// Makes a file in memory from a fuzzer's bytes, for readers that take paths.
#pragma once

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace nightcity::test {

class FuzzFile {
 public:
  FuzzFile(const std::uint8_t* data, std::size_t size)
      : descriptor_(::memfd_create("fuzz", MFD_CLOEXEC)) {
    if (descriptor_ < 0) std::abort();
    for (std::size_t done = 0; done < size;) {
      const ssize_t n = ::write(descriptor_, data + done, size - done);
      if (n <= 0) std::abort();
      done += static_cast<std::size_t>(n);
    }
  }
  // libosmium leaves the descriptor of a PBF open that is broken (PBFParser::run closes it at the
  // end alone), and a fuzzer reads thousands: without descriptors the sanitizers' own checks, which
  // need a pipe, report what is not there. Readers have ended here: what is still open is theirs.
  ~FuzzFile() {
    constexpr int most = 16;  // that a reader leaves: the lowest free numbers are taken first
    struct stat own {
    }, other{};
    if (::fstat(descriptor_, &own) == 0)
      for (int n = descriptor_ + 1; n <= descriptor_ + most; ++n)
        if (::fstat(n, &other) == 0 && other.st_dev == own.st_dev && other.st_ino == own.st_ino)
          ::close(n);
    ::close(descriptor_);
  }
  FuzzFile(const FuzzFile&) = delete;
  FuzzFile& operator=(const FuzzFile&) = delete;

  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

}  // namespace nightcity::test
