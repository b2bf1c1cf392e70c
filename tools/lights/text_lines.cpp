#include "tools/lights/text_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <utility>

#include "formats/error.h"
#include "formats/input_file.h"
#include "tools/city/text_encoding.h"

namespace nightcity::lights {
namespace {

std::string read_content(const std::filesystem::path& file) {
  refuse_special_file(file);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) throw Error(file.string(), "no such file");
  if (size > largest_luminaire_file) throw Error(file.string(), "too large for a luminaire file");
  std::ifstream stream(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

}  // namespace

TextLines::TextLines(std::filesystem::path file) : TextLines(file.string(), read_content(file)) {}

TextLines::TextLines(std::string name, std::string content)
    : name_(std::move(name)), content_(std::move(content)) {
  if (content_.size() > largest_luminaire_file)
    throw Error(name_, "too large for a luminaire file");
  if (content_.empty()) throw Error(name_, "the file is empty");
  content_ = city::to_utf8(std::move(content_));
  if (content_.starts_with("\xef\xbb\xbf")) content_.erase(0, 3);
  content_ = city::decode_text(std::move(content_));
  if (const std::size_t end = content_.find('\x1a'); end != std::string::npos) content_.resize(end);
  // Old programs fill the last block of a file with zeros.
  content_.resize(content_.find_last_not_of('\0') + 1);
  if (content_.find('\0') != std::string::npos) throw Error(name_, "not a text file");
  // Breaks of pages and blanks that do not break lines are blanks.
  std::replace_if(
      content_.begin(), content_.end(), [](char c) { return c == '\f' || c == '\v'; }, ' ');
  std::size_t kept = 0;
  for (std::size_t at = 0; at < content_.size(); ++at) {
    const bool is_blank = content_.compare(at, 2, "\xc2\xa0") == 0;
    content_[kept++] = is_blank ? ' ' : content_[at];
    at += is_blank;
  }
  content_.resize(kept);

  std::string_view rest = content_;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end);
    rest.remove_prefix(rest.starts_with("\r\n") ? 2 : rest.empty() ? 0 : 1);
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string_view::npos)
      line = {};
    else
      line = line.substr(first, line.find_last_not_of(" \t") - first + 1);
    lines_.push_back({line, number});
  }
  if (lines_.empty()) throw Error(name_, "the file is empty");
}

std::size_t TextLines::find_line(std::size_t byte) const {
  const auto begins_behind = [this](std::size_t at, const Line& line) {
    return at < static_cast<std::size_t>(line.text.data() - content_.data());
  };
  const auto next = std::upper_bound(lines_.begin(), lines_.end(), byte, begins_behind);
  return next == lines_.begin() ? 1 : std::prev(next)->number;
}

void TextLines::fail(std::size_t number, const std::string& message) const {
  throw Error(name_, number, message);
}

double TextLines::number(std::string_view text, std::size_t line, std::string_view what) const {
  std::string digits(text);
  for (char& c : digits)
    if (c == ',') c = '.';
  // Fortran writes an exponent of double precision with D.
  for (std::size_t i = 1; i + 1 < digits.size(); ++i)
    if ((digits[i] == 'D' || digits[i] == 'd') && digits[i - 1] >= '.' && digits[i - 1] <= '9')
      digits[i] = 'e';
  const char* from = digits.data() + (digits.starts_with('+') ? 1 : 0);
  const char* end = digits.data() + digits.size();
  double value = 0;
  const auto [stop, error] = std::from_chars(from, end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value))
    fail(line, "\"" + digits.substr(0, 40) + "\" is no number (" + std::string(what) + ")");
  return value;
}

int TextLines::integer(std::string_view text, std::size_t line, std::string_view what, int low,
                       int high) const {
  const double value = number(text, line, what);
  if (value != std::floor(value) || value < low || value > high)
    fail(line, std::string(what) + " is " + std::string(text) + ", not a whole number from " +
                   std::to_string(low) + " to " + std::to_string(high));
  return static_cast<int>(value);
}

}  // namespace nightcity::lights
