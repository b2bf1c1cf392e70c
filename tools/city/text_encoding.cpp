#include "tools/city/text_encoding.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <utility>

namespace nightcity::city {
namespace {

constexpr char32_t replacement = 0xFFFD;
constexpr std::size_t looked_at_bytes = 512;  // for an encoding that no mark names
constexpr std::size_t block_bytes = std::size_t{1} << 16;

void append_utf8(char32_t c, std::string& out) {
  const auto put = [&out](char32_t byte) { out += static_cast<char>(byte); };
  if (c < 0x80) {
    put(c);
  } else if (c < 0x800) {
    put(0xC0 | c >> 6);
    put(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    put(0xE0 | c >> 12);
    put(0x80 | (c >> 6 & 0x3F));
    put(0x80 | (c & 0x3F));
  } else {
    put(0xF0 | c >> 18);
    put(0x80 | (c >> 12 & 0x3F));
    put(0x80 | (c >> 6 & 0x3F));
    put(0x80 | (c & 0x3F));
  }
}

/// Passes a document on whose first bytes have been read already; without a rest these are all.
class ResumedSource : public ByteSource {
 public:
  ResumedSource(std::string start, std::unique_ptr<ByteSource> rest)
      : start_(std::move(start)), rest_(std::move(rest)) {}

  std::size_t read(char* out, std::size_t size) override {
    if (at_ == start_.size()) return rest_ ? rest_->read(out, size) : 0;
    const std::size_t n = std::min(size, start_.size() - at_);
    std::memcpy(out, start_.data() + at_, n);
    at_ += n;
    return n;
  }

 private:
  std::string start_;
  std::size_t at_ = 0;
  std::unique_ptr<ByteSource> rest_;
};

/// The widths of UTF-16 and UTF-32 in bytes.
enum class UnitBytes : std::size_t { two = 2, four = 4 };

class WideSource : public ByteSource {
 public:
  WideSource(std::unique_ptr<ByteSource> source, UnitBytes width, bool big_endian)
      : source_(std::move(source)),
        width_(static_cast<std::size_t>(width)),
        big_endian_(big_endian) {}

  std::size_t read(char* out, std::size_t size) override {
    while (at_ == text_.size() && !ended_) translate_block();
    const std::size_t n = std::min(size, text_.size() - at_);
    std::memcpy(out, text_.data() + at_, n);
    at_ += n;
    return n;
  }

 private:
  void translate_block() {
    text_.clear();
    at_ = 0;
    bytes_.resize(kept_ + block_bytes);
    const std::size_t got = source_->read(bytes_.data() + kept_, block_bytes);
    const std::size_t size = kept_ + got;
    ended_ = got == 0;
    std::size_t i = 0;
    for (; i + width_ <= size; i += width_) take_unit(unit_at(i));
    kept_ = size - i;
    std::memmove(bytes_.data(), bytes_.data() + i, kept_);
    if (!ended_) return;
    if (kept_ > 0 || high_ != 0) append_utf8(replacement, text_);
  }

  char32_t unit_at(std::size_t i) const {
    char32_t unit = 0;
    for (std::size_t k = 0; k < width_; ++k)
      unit =
          unit << 8 | static_cast<std::uint8_t>(bytes_[big_endian_ ? i + k : i + width_ - 1 - k]);
    return unit;
  }

  void take_unit(char32_t unit) {
    const bool high = unit >= 0xD800 && unit < 0xDC00, low = unit >= 0xDC00 && unit < 0xE000;
    if (high_ != 0 && low) {
      append_utf8(0x10000 + ((high_ - 0xD800) << 10) + (unit - 0xDC00), text_);
      high_ = 0;
      return;
    }
    if (high_ != 0) append_utf8(replacement, text_);
    high_ = high ? unit : 0;
    constexpr char32_t last = 0x10FFFF;
    if (!high) append_utf8(low || unit > last ? replacement : unit, text_);
  }

  std::unique_ptr<ByteSource> source_;
  std::size_t width_;
  bool big_endian_, ended_ = false;
  std::string bytes_, text_;
  std::size_t kept_ = 0, at_ = 0;
  char32_t high_ = 0;  // the first half of a surrogate pair, seen last
};

// Returns the length of the valid UTF-8 sequence at `i`, 0 where there is none.
std::size_t sequence_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) {
    return k < text.size() ? static_cast<std::uint8_t>(text[k]) : std::uint8_t{0};
  };
  const std::uint8_t first = byte(i), second = byte(i + 1);
  const auto continues = [&](std::size_t k) { return (byte(k) & 0xC0) == 0x80; };
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4 || !continues(i + 1)) return 0;
  if (first < 0xE0) return 2;
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F)) return 0;
  if (!continues(i + 2)) return 0;
  if (first < 0xF0) return 3;
  if ((first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F)) return 0;
  return continues(i + 3) ? 4 : 0;
}

// Returns where the first byte stands that is part of no valid sequence; the size where none is.
std::size_t find_invalid(std::string_view text) {
  std::size_t sound = 0;
  while (sound < text.size()) {
    const std::size_t length = sequence_length(text, sound);
    if (length == 0) break;
    sound += length;
  }
  return sound;
}

// Tells of the beginning of a text that is read as UTF-16 in one order of bytes.
struct WideReading {
  bool is_sound = true;  // no control characters, no halves of pairs alone
  std::size_t units = 0;
  std::size_t ascii = 0;  // blanks, separators, digits and Latin letters
};

WideReading read_as_utf16(std::string_view start, bool big_endian) {
  WideReading reading;
  bool is_behind_high = false;
  for (std::size_t i = 0; i + 1 < start.size(); i += 2) {
    const auto byte = [&](std::size_t k) { return static_cast<std::uint8_t>(start[k]); };
    const unsigned unit = big_endian ? byte(i) * 256u + byte(i + 1) : byte(i + 1) * 256u + byte(i);
    const bool is_blank = unit == '\t' || unit == '\n' || unit == '\r';
    const bool is_control = (unit < ' ' && !is_blank) || (unit >= 0x7F && unit < 0xA0);
    const bool is_high = unit >= 0xD800 && unit < 0xDC00, is_low = unit >= 0xDC00 && unit < 0xE000;
    if (is_control || unit >= 0xFFFE || is_low != is_behind_high) reading.is_sound = false;
    is_behind_high = is_high;
    reading.ascii += is_blank || (unit >= ' ' && unit < 0x7F) ? 1 : 0;
    ++reading.units;
  }
  return reading;
}

enum class Utf16 : std::uint8_t { none, little, big };

// Text in any script has blanks, commas, ends of lines or digits, which are letters of rare scripts
// where the order of bytes is the other one.
Utf16 find_unmarked_utf16(std::string_view start) {
  constexpr std::size_t least_units = 8, least_ascii = 2, most_between = 32;
  start = start.substr(0, looked_at_bytes);
  const WideReading little = read_as_utf16(start, false), big = read_as_utf16(start, true);
  const auto is_it = [&](const WideReading& one, const WideReading& other) {
    return one.is_sound && one.units >= least_units && one.ascii >= least_ascii &&
           one.ascii * most_between >= one.units && one.ascii > 2 * other.ascii;
  };
  if (is_it(little, big)) return Utf16::little;
  return is_it(big, little) ? Utf16::big : Utf16::none;
}

Utf16 find_utf16(std::string_view start) {
  using namespace std::string_view_literals;
  if (start.starts_with("\xff\xfe"sv) || start.starts_with("<\0"sv)) return Utf16::little;
  if (start.starts_with("\xfe\xff"sv) || start.starts_with("\0<"sv)) return Utf16::big;
  return find_unmarked_utf16(start);
}

}  // namespace

bool begins_as_utf16(std::string_view start) {
  return find_utf16(start) != Utf16::none;
}

bool begins_as_utf32(std::string_view start) {
  using namespace std::string_view_literals;
  return start.starts_with("\xff\xfe\0\0"sv) || start.starts_with("\0\0\xfe\xff"sv) ||
         start.starts_with("<\0\0\0"sv) || start.starts_with("\0\0\0<"sv);
}

std::unique_ptr<ByteSource> to_utf8(std::unique_ptr<ByteSource> source) {
  std::string start = read_next(*source, looked_at_bytes);
  const bool utf32 = begins_as_utf32(start), utf16 = !utf32 && begins_as_utf16(start);
  const bool big_endian = utf32 ? start.starts_with('\0') : find_utf16(start) == Utf16::big;
  auto whole = std::make_unique<ResumedSource>(std::move(start), std::move(source));
  if (!utf16 && !utf32) return whole;
  return std::make_unique<WideSource>(std::move(whole), utf32 ? UnitBytes::four : UnitBytes::two,
                                      big_endian);
}

std::string to_utf8(std::string text) {
  if (!begins_as_utf16(text) && !begins_as_utf32(text)) return text;
  const auto source = to_utf8(std::make_unique<ResumedSource>(std::move(text), nullptr));
  return read_next(*source, std::string::npos);
}

std::unique_ptr<ByteSource> resume(std::string start, std::unique_ptr<ByteSource> rest) {
  return std::make_unique<ResumedSource>(std::move(start), std::move(rest));
}

std::string decode_text(std::string text) {
  constexpr std::array<char32_t, 32> signs{
      0x20AC, 0xFFFD, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
      0x2039, 0x0152, 0xFFFD, 0x017D, 0xFFFD, 0xFFFD, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
      0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0xFFFD, 0x017E, 0x0178};
  if (find_invalid(text) == text.size()) return text;
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<std::uint8_t>(c);
    append_utf8(byte >= 0x80 && byte < 0xA0 ? signs[byte - 0x80] : byte, out);
  }
  return out;
}

std::string to_valid_utf8(std::string text) {
  const std::size_t sound = find_invalid(text);
  if (sound == text.size()) return text;
  std::string out = text.substr(0, sound);
  for (std::size_t i = sound; i < text.size();) {
    const std::size_t length = sequence_length(text, i);
    if (length == 0)
      append_utf8(replacement, out);
    else
      out.append(text, i, length);
    i += std::max<std::size_t>(length, 1);
  }
  return out;
}

}  // namespace nightcity::city
