#include "tools/inventory/loose_json.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace nightcity::inventory {
namespace {

constexpr std::string_view blanks_of_json = " \t\r\n\x1e";

bool is_in_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '$' || c == '.' || c == '-' || c == '+';
}

// Returns where the comment that begins at `at` ends; `at` where there is none.
std::size_t find_end_of_comment(std::string_view text, std::size_t at) {
  const std::string_view rest = text.substr(at);
  if (rest.starts_with("//")) return std::min(text.find('\n', at), text.size());
  if (!rest.starts_with("/*")) return at;
  const std::size_t end = text.find("*/", at + 2);
  return end == text.npos ? text.size() : end + 2;
}

// Returns where the JSON of a script begins: behind a name and "=" or "(", or comments. 0 where the
// text begins otherwise.
std::size_t find_begin(std::string_view text) {
  constexpr std::size_t longest = 1000;
  constexpr std::string_view between = "=(; \t\r\n\x1e\xef\xbb\xbf";
  for (std::size_t at = 0; at < std::min(text.size(), longest);) {
    if (text[at] == '{' || text[at] == '[') return at;
    const std::size_t end = find_end_of_comment(text, at);
    if (end > at)
      at = end;
    else if (is_in_word(text[at]) || between.find(text[at]) != between.npos)
      ++at;
    else
      break;
  }
  return 0;
}

class Straightener {
 public:
  explicit Straightener(std::string_view text) : text_(text), at_(find_begin(text)) {}

  std::string run() {
    while (at_ < text_.size() && !is_behind_all()) step();
    return is_many_ ? "[" + out_ + "]" : out_;
  }

 private:
  // The end of a call or an assignment stands behind all. What follows it, as the rows of another
  // variable, is kept: it makes broken JSON, where rows would be lost without a word.
  bool is_behind_all() {
    constexpr std::string_view ends = ");", between = "); \t\r\n\x1e";
    if (depth_ > 0 || out_.empty() || goes_on_ || ends.find(text_[at_]) == ends.npos) return false;
    std::size_t at = at_;
    while (at < text_.size()) {
      const std::size_t end = find_end_of_comment(text_, at);
      if (end == at && between.find(text_[at]) == between.npos) break;
      at = std::max(end, at + 1);
    }
    goes_on_ = at < text_.size();
    return !goes_on_;
  }

  void step() {
    const char c = text_[at_];
    if (const std::size_t end = find_end_of_comment(text_, at_); end > at_) {
      at_ = end;
    } else if (c == '"') {
      take_text();
    } else if (is_in_word(c)) {
      take_word();
    } else {
      if (c == '{' || c == '[') open();
      if (c == '}' || c == ']') close();
      out_ += c;
      ++at_;
    }
  }

  void open() {
    if (depth_++ > 0) return;
    const std::size_t last = out_.find_last_not_of(blanks_of_json);
    if (last == out_.npos) return;
    is_many_ = true;
    if (out_[last] != ',') out_ += ',';
  }

  void close() {
    depth_ = std::max(depth_ - 1, 0);
    const std::size_t last = out_.find_last_not_of(blanks_of_json);
    if (last != out_.npos && out_[last] == ',') out_[last] = ' ';
  }

  void take_text() {
    const std::size_t begin = at_++;
    while (at_ < text_.size() && text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
    at_ = std::min(at_ + 1, text_.size());
    out_ += text_.substr(begin, at_ - begin);
  }

  void take_word() {
    constexpr std::array<std::string_view, 8> nothing{"NaN",       "-NaN", "nan",       "Infinity",
                                                      "-Infinity", "None", "undefined", "NA"};
    constexpr std::size_t most_digits = 18;
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_in_word(text_[at_])) ++at_;
    const std::string_view word = text_.substr(begin, at_ - begin);
    const bool is_long = word.size() > most_digits &&
                         word.find_first_not_of("0123456789", word[0] == '-') == word.npos;
    if (std::find(nothing.begin(), nothing.end(), word) != nothing.end())
      out_ += "null";
    else
      (is_long ? (out_ += '"') += word : out_ += word) += is_long ? "\"" : "";
  }

  std::string_view text_;
  std::size_t at_;
  std::string out_;
  int depth_ = 0;
  bool is_many_ = false, goes_on_ = false;
};

}  // namespace

bool begins_as_loose_json(std::string_view start) {
  const std::size_t begin = find_begin(start);
  return begin < start.size() && (start[begin] == '{' || start[begin] == '[');
}

std::string straighten_json(std::string_view text) {
  return Straightener(text).run();
}

}  // namespace nightcity::inventory
