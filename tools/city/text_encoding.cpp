#include "tools/city/text_encoding.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

namespace nightcity::city {
namespace {

constexpr char32_t replacement = 0xFFFD;
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

/// Passes a document on whose first bytes have been read already.
class ResumedSource : public ByteSource {
 public:
  ResumedSource(std::string start, std::unique_ptr<ByteSource> rest)
      : start_(std::move(start)), rest_(std::move(rest)) {}

  std::size_t read(char* out, std::size_t size) override {
    if (at_ == start_.size()) return rest_->read(out, size);
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

class Utf16Source : public ByteSource {
 public:
  Utf16Source(std::unique_ptr<ByteSource> source, bool big_endian)
      : source_(std::move(source)), big_endian_(big_endian) {}

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
    for (; i + 1 < size; i += 2) take_unit(unit_at(i));
    kept_ = size - i;
    if (kept_ == 1) bytes_[0] = bytes_[i];
    if (!ended_) return;
    if (kept_ == 1 || high_ != 0) append_utf8(replacement, text_);
  }

  char32_t unit_at(std::size_t i) const {
    const auto a = static_cast<std::uint8_t>(bytes_[i]),
               b = static_cast<std::uint8_t>(bytes_[i + 1]);
    return big_endian_ ? static_cast<char32_t>(a << 8 | b) : static_cast<char32_t>(b << 8 | a);
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
    if (!high) append_utf8(low ? replacement : unit, text_);
  }

  std::unique_ptr<ByteSource> source_;
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

}  // namespace

bool begins_as_utf16(std::string_view start) {
  using namespace std::string_view_literals;
  return start.starts_with("\xff\xfe"sv) || start.starts_with("\xfe\xff"sv) ||
         start.starts_with("<\0"sv) || start.starts_with("\0<"sv);
}

std::unique_ptr<ByteSource> to_utf8(std::unique_ptr<ByteSource> source) {
  std::string start(4, '\0');
  std::size_t size = 0;
  while (size < start.size()) {
    const std::size_t got = source->read(start.data() + size, start.size() - size);
    if (got == 0) break;
    size += got;
  }
  start.resize(size);
  const bool utf16 = begins_as_utf16(start);
  const bool big_endian = start.starts_with('\xfe') || start.starts_with('\0');
  auto whole = std::make_unique<ResumedSource>(std::move(start), std::move(source));
  if (!utf16) return whole;
  return std::make_unique<Utf16Source>(std::move(whole), big_endian);
}

std::string to_valid_utf8(std::string text) {
  std::size_t sound = 0;
  while (sound < text.size()) {
    const std::size_t length = sequence_length(text, sound);
    if (length == 0) break;
    sound += length;
  }
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
