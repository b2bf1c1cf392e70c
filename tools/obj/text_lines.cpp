#include "tools/obj/text_lines.h"

#include <cmath>
#include <cstring>
#include <utility>

#include "formats/error.h"
#include "tools/decimal.h"

namespace nightcity::obj {
namespace {

constexpr std::size_t chunk_bytes = std::size_t{1} << 20;
constexpr std::size_t max_line_bytes = std::size_t{16} << 20;

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace

TextLines::TextLines(std::unique_ptr<city::ByteSource> source, std::string name)
    : source_(std::move(source)), name_(std::move(name)), buffer_(chunk_bytes) {
  fill();
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  if (std::string_view(buffer_.data(), end_).starts_with(mark)) begin_ = mark.size();
}

// Returns false at the end of the file.
bool TextLines::fill() {
  if (is_over_) return false;
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (end_ == buffer_.size()) {
    if (buffer_.size() >= max_line_bytes)
      throw Error(name_, physical_ + 1, "a line is longer than 16 MB");
    buffer_.resize(2 * buffer_.size());
  }
  const std::size_t got = source_->read(buffer_.data() + end_, buffer_.size() - end_);
  is_over_ = got == 0;
  end_ += got;
  return !is_over_;
}

bool TextLines::next_physical(std::string_view& line) {
  std::size_t looked = 0;  // bytes behind begin_ that hold no end of a line
  for (;;) {
    if (skip_newline_ && begin_ < end_) {
      if (buffer_[begin_] == '\n') ++begin_;
      skip_newline_ = false;
    }
    const std::string_view rest(buffer_.data() + begin_, end_ - begin_);
    const std::size_t at = rest.find_first_of("\r\n", looked);
    if (at != std::string_view::npos) {
      line = rest.substr(0, at);
      skip_newline_ = rest[at] == '\r';
      begin_ += at + 1;
      ++physical_;
      return true;
    }
    looked = rest.size();
    if (fill()) continue;
    if (rest.empty()) return false;
    line = std::string_view(buffer_.data() + begin_, end_ - begin_);
    begin_ = end_;
    ++physical_;
    return true;
  }
}

bool TextLines::next(std::string_view& line) {
  std::string_view part;
  while (next_physical(part)) {
    number_ = physical_;
    part = trim(part);
    // A comment does not go on: many end with a path of Windows.
    if (part.empty() || part.front() == '#') continue;
    if (part.back() != '\\') {
      line = part;
      return true;
    }
    joined_.clear();
    for (;;) {
      const bool goes_on = part.ends_with('\\');
      joined_ += goes_on ? part.substr(0, part.size() - 1) : part;
      joined_ += ' ';
      if (joined_.size() > max_line_bytes)
        throw Error(name_, number_, "a line is longer than 16 MB");
      if (!goes_on || !next_physical(part)) break;
      part = trim(part);
    }
    line = trim(joined_);
    if (!line.empty()) return true;
  }
  return false;
}

std::string_view take_word(std::string_view& text) {
  text = trim(text);
  std::size_t size = 0;
  while (size < text.size() && !is_blank(text[size])) ++size;
  const std::string_view word = text.substr(0, size);
  text.remove_prefix(size);
  return word;
}

bool take_number(std::string_view& text, double& value) {
  std::string_view rest = trim(text);
  if (rest.starts_with('+')) rest.remove_prefix(1);
  const auto [end, error] = parse_decimal(rest.data(), rest.data() + rest.size(), value);
  const auto size = static_cast<std::size_t>(end - rest.data());
  if (error != std::errc() || !std::isfinite(value) ||
      (size < rest.size() && !is_blank(rest[size])))
    return false;
  text = rest.substr(size);
  return true;
}

}  // namespace nightcity::obj
