#include "tools/terrain/height_words.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "formats/to_lower.h"

namespace nightcity::terrain {
namespace {

constexpr std::string_view between = " \t,;\r\n";
// The least number of 32 bits, which stands for no height (fill_value.h), also where GDAL takes the
// table for whole numbers.
constexpr std::string_view unknown_height = " -3.4028235e+38";

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// Returns whether a word begins as numbers do: "-.5", "1.#QNAN" too, which GDAL knows.
bool begins_as_number(std::string_view word) {
  for (const std::string_view front : {"+-", "."})
    if (!word.empty() && front.find(word.front()) != front.npos) word.remove_prefix(1);
  return !word.empty() && is_digit(word.front());
}

std::vector<std::string_view> split_words(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    line.remove_prefix(std::min(line.find_first_not_of(between), line.size()));
    if (line.empty()) return words;
    const std::size_t end = std::min(line.find_first_of(between), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

// Returns whether a word is one that programs write for a height that they do not know: "-nan",
// "nan(ind)" and "---" too. Others may have a meaning in one of the formats.
bool stands_for_unknown(std::string_view text) {
  constexpr std::array<std::string_view, 11> known{
      "na", "n/a", "#n/a", "null", "nodata", "no_data", "none", "nil", "void", "nd", "missing"};
  if (text.find_first_not_of("*-?_") == text.npos) return true;
  if (text.front() == '-' || text.front() == '+') text.remove_prefix(1);
  const std::string word = to_lower(text);
  return word.starts_with("nan") || word.starts_with("inf") ||
         std::find(known.begin(), known.end(), word) != known.end();
}

enum class Line : std::uint8_t { head, numbers, foreign };

// Returns whether a line stands before the numbers, as a key of a grid's head or names of columns
// do, or is no line of a table.
Line find_kind(const std::vector<std::string_view>& words) {
  if (words.empty()) return Line::head;
  const std::string_view word = words.front();
  if (to_lower(word).starts_with("nodata") && words.size() <= 2) return Line::head;
  if (begins_as_number(word) || stands_for_unknown(word)) return Line::numbers;
  const char first = word.front();
  return is_letter(first) || first == '#' || first == '"' ? Line::head : Line::foreign;
}

// Returns false where a text surely holds numbers alone: their letters are those of exponents. Most
// texts are passed over at the speed of this loop.
bool may_hold_words(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_digit(c) || c == ' ' || c == '.' || c == '\n') continue;
    const char next = i + 1 < text.size() ? text[i + 1] : ' ';
    const bool is_sign = c == '-' || c == '+';
    const bool is_exponent = c == 'e' || c == 'E';
    if (is_sign ? !is_digit(next) && next != '.' : !is_exponent && between.find(c) == between.npos)
      return true;
  }
  return false;
}

class HeightWords final : public city::ByteSource {
 public:
  explicit HeightWords(std::unique_ptr<city::ByteSource> source) : source_(std::move(source)) {}

  std::size_t read(char* out, std::size_t size) override {
    while (given_ == ready_.size() && !ended_) fill();
    const std::size_t count = std::min(size, ready_.size() - given_);
    std::memcpy(out, ready_.data() + given_, count);
    given_ += count;
    return count;
  }

  bool has_changed() const { return changed_; }

 private:
  void fill() {
    constexpr std::size_t piece = 1 << 16;
    ready_.clear();
    given_ = 0;
    std::string read(piece, '\0');
    read.resize(source_->read(read.data(), read.size()));
    ended_ = read.empty();
    pending_ += read;
    while (part_ == Line::head && take_head_line()) continue;
    if (part_ == Line::numbers) take_words();
    if (part_ == Line::foreign) ready_ += std::exchange(pending_, {});
  }

  // Takes a line off what is pending, unless the numbers begin with it or its end is to come.
  bool take_head_line() {
    constexpr std::size_t longest = 1 << 20;
    if (pending_.empty()) return false;
    const std::size_t end = pending_.find('\n');
    if (end == std::string::npos && !ended_ && pending_.size() < longest) return false;
    const std::string line = pending_.substr(0, std::min(end, pending_.size() - 1) + 1);
    const std::vector<std::string_view> words = split_words(line);
    part_ = find_kind(words);
    if (part_ != Line::head) return false;
    const bool is_unknown = words.size() == 2 && to_lower(words[0]).starts_with("nodata") &&
                            !begins_as_number(words[1]);
    if (is_unknown)
      ready_ += std::string(words[0]) + std::string(unknown_height) + "\n";
    else
      ready_ += line;
    changed_ = changed_ || is_unknown;
    pending_.erase(0, line.size());
    return true;
  }

  // Takes all words whose end is there.
  void take_words() {
    constexpr std::size_t longest = 4096;
    const std::size_t whole = ended_ ? pending_.size() : pending_.find_last_of(between) + 1;
    if (!may_hold_words(std::string_view(pending_).substr(0, whole))) {
      ready_.append(pending_, 0, whole);
      pending_.erase(0, whole);
    }
    std::string_view rest = pending_;
    while (!rest.empty()) {
      const std::size_t blanks = std::min(rest.find_first_not_of(between), rest.size());
      ready_ += rest.substr(0, blanks);
      rest.remove_prefix(blanks);
      const std::size_t end = rest.find_first_of(between);
      if (end == rest.npos && !ended_ && rest.size() < longest) break;
      const std::string_view word = rest.substr(0, end);
      const bool is_kept = word.empty() || begins_as_number(word) || !stands_for_unknown(word);
      ready_ += is_kept ? word : unknown_height;
      changed_ = changed_ || !is_kept;
      rest.remove_prefix(word.size());
    }
    pending_.erase(0, pending_.size() - rest.size());
  }

  std::unique_ptr<city::ByteSource> source_;
  std::string pending_, ready_;
  std::size_t given_ = 0;
  Line part_ = Line::head;
  bool ended_ = false, changed_ = false;
};

}  // namespace

bool begins_as_text(std::string_view start) {
  constexpr char first_printable = ' ';
  return std::none_of(start.begin(), start.end(), [](char c) {
    return c >= 0 && c < first_printable && std::strchr("\t\n\v\f\r\x1a", c) == nullptr;
  });
}

std::unique_ptr<city::ByteSource> replace_height_words(std::unique_ptr<city::ByteSource> source) {
  return std::make_unique<HeightWords>(std::move(source));
}

bool has_height_words(std::unique_ptr<city::ByteSource> source) {
  constexpr std::size_t piece = 1 << 16;
  HeightWords words(std::move(source));
  std::string unused(piece, '\0');
  while (!words.has_changed() && words.read(unused.data(), unused.size()) > 0) continue;
  return words.has_changed();
}

}  // namespace nightcity::terrain
