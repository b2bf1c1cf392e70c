#include "tools/city/rar_sums.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

namespace nightcity::city {
namespace {

constexpr std::string_view mark_of_5 = "Rar!\x1A\x07\x01", mark_of_4 = "Rar!\x1A\x07";
constexpr std::size_t begin_of_4 = 7, begin_of_5 = 8;
constexpr std::size_t most_header_bytes = 4096;  // what is asked for lies before the name

// Takes numbers from a header; zeros behind its end.
class RarNumbers {
 public:
  explicit RarNumbers(std::string_view bytes) : bytes_(bytes) {}

  void skip(unsigned count) {
    for (unsigned i = 0; i < count; ++i) take_byte();
  }
  // At most eight bytes.
  std::uint64_t take_fixed(unsigned count) {
    std::uint64_t value = 0;
    for (unsigned i = 0; i < count; ++i) value |= std::uint64_t{take_byte()} << 8 * i;
    return value;
  }
  // Seven bits a byte, the lowest first.
  std::uint64_t take() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 63; shift += 7) {
      const unsigned char byte = take_byte();
      value |= std::uint64_t{byte & 0x7Fu} << shift;
      if (byte < 0x80) break;
    }
    return value;
  }
  std::size_t at() const { return at_; }

 private:
  unsigned char take_byte() {
    return at_ < bytes_.size() ? static_cast<unsigned char>(bytes_[at_++]) : 0;
  }
  std::string_view bytes_;
  std::size_t at_ = 0;
};

struct RarHeader {
  std::uint64_t bytes = 0;  // of it and of the data behind it; 0: no header
  bool is_main = false, is_file = false;
  std::uint64_t flags = 0;  // of the archive, where it is the main one
  std::optional<std::uint32_t> sum{};
};

// crc type flags size [packed size, unpacked size, system, sum, ...]
RarHeader read_header_of_4(std::string_view bytes) {
  constexpr std::uint64_t main = 0x73, file = 0x74, has_data = 0x8000, is_large = 0x100,
                          folder = 0xE0;
  RarNumbers numbers(bytes);
  numbers.skip(2);
  const std::uint64_t type = numbers.take_fixed(1), flags = numbers.take_fixed(2);
  RarHeader header{numbers.take_fixed(2), type == main, type == file, flags};
  if (header.bytes < begin_of_4) return {};
  if (type != file && (flags & has_data) == 0) return header;
  header.bytes += numbers.take_fixed(4);
  numbers.skip(4 + 1);
  const auto sum = static_cast<std::uint32_t>(numbers.take_fixed(4));
  if (header.is_file && (flags & folder) != folder) header.sum = sum;
  numbers.skip(4 + 1 + 1 + 2 + 4);
  if (header.is_file && (flags & is_large) != 0) header.bytes += numbers.take_fixed(4) << 32;
  return header;
}

// crc size type flags [extra size] [data size] [flags, unpacked size, attributes, time, sum, ...]
RarHeader read_header_of_5(std::string_view bytes) {
  constexpr std::uint64_t main = 1, file = 2, has_extra = 1, has_data = 2, folder = 1, has_time = 2,
                          has_sum = 4;
  RarNumbers numbers(bytes);
  numbers.skip(4);
  const std::uint64_t size = numbers.take();
  if (size == 0 || size > std::uint64_t{1} << 32) return {};
  RarHeader header{size + numbers.at()};
  const std::uint64_t type = numbers.take(), flags = numbers.take();
  header.is_main = type == main;
  header.is_file = type == file;
  if ((flags & has_extra) != 0) numbers.take();
  if ((flags & has_data) != 0) header.bytes += numbers.take();
  header.flags = numbers.take();
  if (!header.is_file) return header;
  numbers.take();
  numbers.take();
  if ((header.flags & has_time) != 0) numbers.skip(4);
  const auto sum = static_cast<std::uint32_t>(numbers.take_fixed(4));
  if ((header.flags & has_sum) != 0 && (header.flags & folder) == 0) header.sum = sum;
  return header;
}

}  // namespace

EntrySums list_rar_sums(const std::string& path) {
  EntrySums sums;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto end = static_cast<std::uint64_t>(std::max<std::streamoff>(file.tellg(), 0));
  std::array<char, most_header_bytes> bytes{};
  const auto read = [&](std::uint64_t at) {
    file.clear();
    file.seekg(static_cast<std::streamoff>(at));
    file.read(bytes.data(), bytes.size());
    return std::string_view(bytes.data(), static_cast<std::size_t>(file.gcount()));
  };
  const bool is_5 = read(0).starts_with(mark_of_5);
  for (std::uint64_t at = is_5 ? begin_of_5 : begin_of_4; at < end;) {
    const RarHeader header = is_5 ? read_header_of_5(read(at)) : read_header_of_4(read(at));
    if (header.bytes == 0 || header.bytes > end - at) break;
    if (header.is_file) sums.push_back(header.sum);
    at += header.bytes;
  }
  return sums;
}

bool is_rar_volume(std::string_view start) {
  if (!start.starts_with(mark_of_4)) return false;
  const bool is_5 = start.starts_with(mark_of_5);
  start.remove_prefix(std::min(start.size(), is_5 ? begin_of_5 : begin_of_4));
  const RarHeader header = is_5 ? read_header_of_5(start) : read_header_of_4(start);
  return header.is_main && (header.flags & 1) != 0;
}

}  // namespace nightcity::city
