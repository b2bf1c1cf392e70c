#include "tools/city/text_encoding.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <utility>

namespace nightcity::city {
namespace {

constexpr char32_t replacement = 0xFFFD;
constexpr std::size_t looked_at_bytes = 32;  // for zeros in every second place
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

// Returns whether zeros are every second of the first bytes, from `first` on, and none of the
// others is a control character: so does text in UTF-16 whose first letters are Latin.
bool alternates(std::string_view start, std::size_t first) {
  const std::string_view looked_at = start.substr(0, looked_at_bytes);
  if (looked_at.size() < looked_at_bytes / 2 || looked_at.size() % 2 != 0) return false;
  for (std::size_t i = 0; i < looked_at.size(); ++i) {
    const char c = looked_at[i];
    const bool is_control = static_cast<std::uint8_t>(c) < ' ';
    if (i % 2 == first ? c != 0 : is_control && c != '\t' && c != '\r' && c != '\n') return false;
  }
  return true;
}

}  // namespace

bool begins_as_utf16(std::string_view start) {
  using namespace std::string_view_literals;
  return start.starts_with("\xff\xfe"sv) || start.starts_with("\xfe\xff"sv) ||
         start.starts_with("<\0"sv) || start.starts_with("\0<"sv) || alternates(start, 0) ||
         alternates(start, 1);
}

bool begins_as_utf32(std::string_view start) {
  using namespace std::string_view_literals;
  return start.starts_with("\xff\xfe\0\0"sv) || start.starts_with("\0\0\xfe\xff"sv) ||
         start.starts_with("<\0\0\0"sv) || start.starts_with("\0\0\0<"sv);
}

std::unique_ptr<ByteSource> to_utf8(std::unique_ptr<ByteSource> source) {
  std::string start = read_next(*source, looked_at_bytes);
  const bool utf32 = begins_as_utf32(start), utf16 = !utf32 && begins_as_utf16(start);
  const bool big_endian = start.starts_with('\xfe') || start.starts_with('\0');
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
