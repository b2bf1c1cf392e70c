#include "tools/town/text_file.h"

#include <charconv>
#include <cmath>

namespace nightcity::town {

TextFile::TextFile(const std::filesystem::path& path) : file_(path) {
  buffer_.reserve(flush_at + 4096);
}

TextFile& TextFile::operator<<(std::int64_t number) {
  char digits[24];
  const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
  return *this << std::string_view(digits, static_cast<std::size_t>(end - digits));
}

TextFile& TextFile::fixed(double value, int decimals) {
  constexpr std::int64_t powers[] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000};
  const std::int64_t power = powers[decimals];
  std::int64_t scaled = std::llround(value * static_cast<double>(power));
  char digits[32];
  char* at = digits;
  if (scaled < 0) {
    *at++ = '-';
    scaled = -scaled;
  }
  at = std::to_chars(at, digits + sizeof digits, scaled / power).ptr;
  if (decimals > 0) *at++ = '.';
  std::int64_t rest = scaled % power;
  for (std::int64_t place = power / 10; place > 0; place /= 10) {
    *at++ = static_cast<char>('0' + rest / place);
    rest %= place;
  }
  return *this << std::string_view(digits, static_cast<std::size_t>(at - digits));
}

void TextFile::flush() {
  file_.write(buffer_);
  buffer_.clear();
}

void TextFile::finish() {
  flush();
  file_.commit();
}

}  // namespace nightcity::town
