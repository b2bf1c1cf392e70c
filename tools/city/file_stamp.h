// Tells whether a file is still the one that was unpacked before, and keeps what was made of it.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <system_error>
#include <utility>

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

/// Keeps what was made of the file that was asked for last, as a command asks for it several times.
template <class Value>
class LastOfFiles {
 public:
  /// Returns what `make()` makes of a file, which is kept if `is_worth(value)` and a change of the
  /// file would show. What was made of another file is freed before.
  template <class Make, class IsWorth>
  Value find(const std::filesystem::path& file, Make make, IsWorth is_worth) {
    const FileStamp stamp(file);
    const std::lock_guard lock(mutex_);
    if (kept_ && kept_->first == stamp) return kept_->second;
    kept_.reset();
    Value value = make();
    if (stamp.is_settled() && is_worth(value)) kept_.emplace(stamp, value);
    return value;
  }

 private:
  std::mutex mutex_;
  std::optional<std::pair<FileStamp, Value>> kept_;
};

}  // namespace nightcity::city
