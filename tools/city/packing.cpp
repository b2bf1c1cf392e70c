#include "tools/city/packing.h"

#include <algorithm>
#include <array>
#include <string>

#include "formats/to_lower.h"

namespace nightcity::city {
namespace {

using namespace std::string_view_literals;

struct PackingMark {
  std::string_view bytes;
  Packing packing;
};

constexpr std::array packing_marks{PackingMark{"\x1F\x8B"sv, Packing::gzip},
                                   PackingMark{"BZh"sv, Packing::bzip2},
                                   PackingMark{"\xFD"
                                               "7zXZ\0"sv,
                                               Packing::xz},
                                   PackingMark{"\x28\xB5\x2F\xFD"sv, Packing::zstd},
                                   PackingMark{"\x04\x22\x4D\x18"sv, Packing::lz4},
                                   PackingMark{"LZIP\x01"sv, Packing::lzip},
                                   PackingMark{"\x1F\x9D"sv, Packing::compress},
                                   PackingMark{"PK\x03\x04"sv, Packing::zip},
                                   PackingMark{"7z\xBC\xAF\x27\x1C"sv, Packing::seven_zip},
                                   PackingMark{"Rar!\x1A\x07"sv, Packing::rar}};

constexpr std::array stream_endings{".gz"sv,   ".bz2"sv, ".xz"sv,  ".lzma"sv,
                                    ".zstd"sv, ".zst"sv, ".lz4"sv, ".lz"sv};
constexpr std::array archive_endings{".zip"sv,  ".tar"sv, ".7z"sv,  ".rar"sv,  ".tgz"sv,  ".tbz"sv,
                                     ".tbz2"sv, ".txz"sv, ".tlz"sv, ".tzst"sv, ".tar.z"sv};

template <class Endings>
std::size_t find_ending(std::string_view name, const Endings& endings) {
  if (name.empty()) return 0;
  for (const std::string_view ending : endings)
    if (name.back() == ending.back() && name.ends_with(ending)) return ending.size();
  return 0;
}

// LZMA has no mark: the usual first byte, a dictionary of 2^n or 2^n + 2^(n-1) bytes, and a size
// that is unknown or below 256 GB are what its own library asks for.
bool is_lzma(std::string_view start) {
  if (start.size() < 13 || start[0] != 0x5D) return false;
  const auto number = [start](std::size_t at, std::size_t bytes) {
    std::uint64_t value = 0;
    for (std::size_t i = bytes; i-- > 0;)
      value = value << 8 | static_cast<unsigned char>(start[at + i]);
    return value;
  };
  const std::uint64_t dictionary = number(1, 4), size = number(5, 8);
  const std::uint64_t rest = dictionary & (dictionary - 1);  // without the lowest bit
  const bool is_usual = dictionary >= 4096 && (rest == 0 || rest == 2 * (dictionary - rest));
  return is_usual && (size == ~std::uint64_t{0} || size < std::uint64_t{1} << 38);
}

// The oldest tars have no mark, but every one the sum of its first block's bytes, in which the sum
// itself counts as blanks.
bool is_tar(std::string_view start) {
  constexpr std::size_t block = 512, sum_at = 148, sum_bytes = 8, mark_at = 257;
  if (start.size() < block || start[0] == '\0') return false;
  if (start.substr(mark_at).starts_with("ustar")) return true;
  std::uint32_t said = 0, sum = 0;
  for (const char c : start.substr(sum_at, sum_bytes)) {
    if (c >= '0' && c <= '7')
      said = said * 8 + static_cast<std::uint32_t>(c - '0');
    else if (c != ' ' && c != '\0')
      return false;
  }
  for (std::size_t i = 0; i < block; ++i)
    sum += i >= sum_at && i < sum_at + sum_bytes ? ' ' : static_cast<unsigned char>(start[i]);
  return said == sum;
}

}  // namespace

Packing find_packing(std::string_view start) {
  for (const PackingMark& mark : packing_marks)
    if (start.starts_with(mark.bytes)) return mark.packing;
  if (is_tar(start)) return Packing::tar;
  return is_lzma(start) ? Packing::lzma : Packing::none;
}

bool is_stream(Packing packing) {
  return packing > Packing::none && packing < Packing::zip;
}

bool is_checked_stream(Packing packing) {
  return is_stream(packing) && packing != Packing::compress;
}

bool is_archive(Packing packing) {
  return packing >= Packing::zip;
}

const char* name_of(Packing packing) {
  constexpr std::array names{"plain", "gzip",     "bzip2", "xz",  "lzma", "zstd", "lz4",
                             "lzip",  "compress", "zip",   "tar", "7z",   "RAR"};
  return names[static_cast<std::size_t>(packing)];
}

std::string_view without_stream_ending(std::string_view name) {
  // Archives have many entries: only what may be an ending is put into lower case.
  constexpr std::size_t longest = std::string_view(".zstd").size();
  const std::string end = to_lower(name.substr(name.size() - std::min(name.size(), longest)));
  return name.substr(0, name.size() - find_ending(end, stream_endings));
}

bool is_named_as_volume(std::string_view name) {
  if (name.ends_with(".rar")) return name.find(".part") != name.npos;
  const std::size_t point = name.rfind('.');
  if (point == name.npos || name.size() - point != std::string_view(".001").size()) return false;
  const std::string_view number = name.substr(point + 1);
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return std::all_of(number.begin(), number.end(), is_digit) &&
         is_named_as_archive(name.substr(0, point));
}

bool is_named_as_archive(std::string_view name) {
  return find_ending(without_stream_ending(name), archive_endings) > 0;
}

bool is_named_as_packed(std::string_view name) {
  return is_named_as_archive(name) || is_named_as_volume(name) ||
         without_stream_ending(name).size() < name.size();
}

}  // namespace nightcity::city
