// Tells whether a file is still the one that was unpacked before, and keeps what was made of it.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <system_error>
#include <vector>

#include "tools/city/unpacked_size.h"

namespace nightcity::city {

/// A file as it was when this was made.
class FileStamp {
 public:
  explicit FileStamp(const std::filesystem::path& file)
      : file_(file), size_(find_packed_size(file)), time_(find_time(file)) {}

  bool operator==(const FileStamp&) const = default;
  bool is_of_same_file(const FileStamp& other) const { return file_ == other.file_; }
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

/// Keeps what was made of the files that were asked for last, as a command asks for each of them
/// several times, and often for several files in turns.
template <class Value>
class LastOfFiles {
 public:
  /// Returns what `make()` makes of a file. It is kept if `count_bytes(value)`, of the disk, is not
  /// 0 and a change of the file would show. What lies longest goes first where there is too much.
  template <class Make, class CountBytes>
  Value find(const std::filesystem::path& file, Make make, CountBytes count_bytes) {
    const FileStamp stamp(file);
    const std::lock_guard lock(mutex_);
    for (const Kept& kept : kept_)
      if (kept.stamp == stamp) return kept.value;
    make_room(stamp);
    Value value = make();
    const std::uint64_t bytes = stamp.is_settled() ? count_bytes(value) : 0;
    if (bytes > 0) kept_.push_back({stamp, value, bytes});
    return value;
  }

 private:
  struct Kept {
    FileStamp stamp;
    Value value;
    std::uint64_t bytes;
  };

  // Before the next is made, so that the disk does not hold it and all of them.
  void make_room(const FileStamp& next) {
    constexpr std::uint64_t most_bytes = std::uint64_t{1} << 30;
    constexpr std::size_t most_files = 64;
    std::uint64_t bytes = 0;
    std::erase_if(kept_, [&](const Kept& kept) { return kept.stamp.is_of_same_file(next); });
    for (const Kept& kept : kept_) bytes += kept.bytes;
    while (!kept_.empty() && (bytes > most_bytes || kept_.size() >= most_files)) {
      bytes -= kept_.front().bytes;
      kept_.erase(kept_.begin());
    }
  }

  std::mutex mutex_;
  std::vector<Kept> kept_;
};

}  // namespace nightcity::city
