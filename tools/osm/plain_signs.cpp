// Signs of typography in tags and tables.
#include <optional>
#include <string>
#include <string_view>

#include "tools/osm/tag_values.h"

namespace nightcity::osm {
namespace {

struct Sign {
  std::string_view sign;
  char plain;  // 0: none stands for it
};

// U+FF01 to U+FF5E are the signs of ASCII as wide as letters of Chinese and Japanese.
std::optional<Sign> find_wide_sign(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (text.size() < 3 || byte(0) != 0xef || (byte(1) != 0xbc && byte(1) != 0xbd)) return {};
  const int code = ((byte(1) & 0x3f) << 6) + (byte(2) & 0x3f) - 0xf00 + 0x20;
  return code > ' ' && code <= '~' ? std::optional(Sign{text.substr(0, 3), static_cast<char>(code)})
                                   : std::nullopt;
}

std::optional<Sign> find_sign(std::string_view text) {
  constexpr Sign signs[] = {
      {"\xc2\xa0", ' '},
      {"\xe2\x80\xaf", ' '},
      {"\xe2\x80\x89", ' '},
      {"\xe2\x80\xb2", '\''},
      {"\xe2\x80\x99", '\''},
      {"\xc2\xb4", '\''},
      {"\xe2\x80\xb3", '"'},
      {"\xe2\x80\x9d", '"'},
      {"\xe2\x80\x90", '-'},
      {"\xe2\x80\x91", '-'},
      {"\xe2\x80\x92", '-'},
      {"\xe2\x80\x93", '-'},
      {"\xe2\x88\x92", '-'},
      {"\xe2\x89\x88", '~'},
      {"\xe3\x80\x9c", '~'},
      // Marks of direction, of places to break and of byte order, which nobody sees.
      {"\xe2\x80\x8b", 0},
      {"\xe2\x80\x8c", 0},
      {"\xe2\x80\x8d", 0},
      {"\xe2\x80\x8e", 0},
      {"\xe2\x80\x8f", 0},
      {"\xe2\x80\xaa", 0},
      {"\xe2\x80\xab", 0},
      {"\xe2\x80\xac", 0},
      {"\xe2\x81\xa0", 0},
      {"\xc2\xad", 0},
      {"\xef\xbb\xbf", 0}};
  for (const Sign& sign : signs)
    if (text.starts_with(sign.sign)) return sign;
  return find_wide_sign(text);
}

}  // namespace

std::string to_plain_signs(std::string_view text) {
  constexpr unsigned char first_beyond_ascii = 0x80;
  std::string out;
  while (!text.empty()) {
    const bool is_plain = static_cast<unsigned char>(text.front()) < first_beyond_ascii;
    const auto sign = is_plain ? std::nullopt : find_sign(text);
    if (!sign)
      out += text.front();
    else if (sign->plain != 0)
      out += sign->plain;
    text.remove_prefix(sign ? sign->sign.size() : 1);
  }
  return out;
}

}  // namespace nightcity::osm
