// Tells whether a file is still the one that was unpacked before.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <system_error>

#include "tools/city/unpacked_size.h"

namespace nightcity::city {

/// A file as it was when this was made.
class FileStamp {
 public:
  explicit FileStamp(const std::filesystem::path& file)
      : file_(file), size_(find_packed_size(file)), time_(find_time(file)) {}

  bool operator==(const FileStamp&) const = default;
  /// Returns whether a change would show: a file that was written a moment ago may be written again
  /// with the same size and time.
  bool is_settled() const {
    constexpr std::chrono::seconds moment(2);
    return std::filesystem::file_time_type::clock::now() - time_ > moment;
  }

 private:
  static std::filesystem::file_time_type find_time(const std::filesystem::path& file) {
    std::error_code ignored;  // the opening says what is wrong
    return std::filesystem::last_write_time(file, ignored);
  }

  std::filesystem::path file_;
  std::uint64_t size_;
  std::filesystem::file_time_type time_;
};

}  // namespace nightcity::city
