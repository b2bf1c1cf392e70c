// A limit for what a small file unpacks to.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "formats/error.h"

namespace nightcity::city {

/// Returns the size of a file; 0 where it is unknown.
inline std::uint64_t find_packed_size(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  return error ? 0 : size;
}

/// Real city models shrink to a twentieth or thirtieth; deflate can shrink blanks to a
/// thousandth. `add` throws Error beyond 200 times the packed size and 1 GB.
class UnpackedSize {
 public:
  UnpackedSize(std::string name, std::uint64_t packed)
      : name_(std::move(name)),
        max_(std::max(max_ratio * std::min(packed, most_packed), free_bytes)) {}

  void add(std::size_t bytes) {
    size_ += bytes;
    if (size_ > max_)
      throw Error(name_, "unpacks to more than " + std::to_string(max_ratio) +
                             " times its size and more than " + std::to_string(free_bytes >> 20) +
                             " MB: if that is right, unpack it yourself and name the result");
  }

 private:
  static constexpr std::uint64_t max_ratio = 200, free_bytes = std::uint64_t{1} << 30,
                                 most_packed = std::uint64_t{1} << 50;  // the product has room
  std::string name_;
  std::uint64_t max_, size_ = 0;
};

}  // namespace nightcity::city
