// A file that lives as long as its test.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>

namespace nightcity::test {

class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content, const std::string& extension = ".gml") {
    static std::atomic<int> counter{0};
    path_ = std::filesystem::temp_directory_path() / ("nightcity_" + std::to_string(::getpid()) +
                                                      "_" + std::to_string(counter++) + extension);
    std::ofstream(path_, std::ios::binary) << content;
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace nightcity::test
