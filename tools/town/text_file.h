// Writes buffered text with numbers that are the same on every platform.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "formats/atomic_file.h"

namespace nightcity::town {

/// The file gets its name only by finish(). Throws Error when it cannot be written.
class TextFile {
 public:
  explicit TextFile(const std::filesystem::path& path);

  TextFile& operator<<(std::string_view text) {
    buffer_ += text;
    if (buffer_.size() >= flush_at) flush();
    return *this;
  }
  TextFile& operator<<(std::int64_t number);
  TextFile& operator<<(int number) { return *this << static_cast<std::int64_t>(number); }
  TextFile& operator<<(std::size_t number) { return *this << static_cast<std::int64_t>(number); }
  /// Writes `value` with 0 to 7 decimals, by integer arithmetic; |value| * 10^decimals must stay
  /// below 2^63.
  TextFile& fixed(double value, int decimals);

  void finish();

 private:
  static constexpr std::size_t flush_at = 1 << 20;
  void flush();

  AtomicFile file_;
  std::string buffer_;
};

}  // namespace nightcity::town
