#include "tools/cityjson/document_index.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "formats/error.h"

namespace nightcity::cityjson {
namespace {

constexpr std::array<std::uint8_t, 256> find_marks() {
  std::array<std::uint8_t, 256> marks{};
  for (const char c : {'"', '{', '}', '[', ']'}) marks[static_cast<unsigned char>(c)] = 1;
  return marks;
}
constexpr std::array<std::uint8_t, 256> is_mark = find_marks();

// Longer ones hold more closing brackets than boundaries are deep.
constexpr std::size_t marks_bytes = 16;

struct Marks {
  std::uint8_t quotes = 0, opening = 0, closing = 0;
};

// Counts the marks of a block. Without branches, so that the compiler looks at all bytes at once.
Marks count_marks(const char* block) {
  Marks marks;
  for (std::size_t i = 0; i < marks_bytes; ++i) {
    const auto c = static_cast<unsigned char>(block[i]);
    const auto folded = static_cast<unsigned char>(c | 0x20);  // '[' to '{', ']' to '}'
    marks.quotes = static_cast<std::uint8_t>(marks.quotes + (c == '"'));
    marks.opening = static_cast<std::uint8_t>(marks.opening + (folded == '{'));
    marks.closing = static_cast<std::uint8_t>(marks.closing + (folded == '}'));
  }
  return marks;
}

class Scanner {
 public:
  Scanner(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  // Calls `member(key)` for each member of an object; it must step over the value.
  template <class Member>
  void scan_object(const Member& member) {
    expect('{');
    if (accept('}')) return;
    do {
      skip_blanks();
      const std::string_view key = scan_text();
      expect(':');
      skip_blanks();
      member(key);
    } while (accept(','));
    expect('}');
  }

  std::size_t place() const { return at_; }
  bool at(char c) const { return at_ < text_.size() && text_[at_] == c; }

  // Steps over a value and returns it.
  std::string_view scan_value() {
    const std::size_t begin = at_;
    if (at('"')) {
      scan_text();
    } else if (at('{') || at('[')) {
      skip_nested();
    } else {
      while (at_ < text_.size() && !ends_scalar(text_[at_])) ++at_;
      if (at_ == begin) fail("a value is missing");
    }
    return text_.substr(begin, at_ - begin);
  }

  void expect_end() {
    skip_blanks();
    if (at_ != text_.size()) fail("something stands behind the document's end");
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw Error(name_, line_of(text_, at_), "not JSON: " + why);
  }
  [[noreturn]] void fail_at_end() const {
    throw Error(name_, line_of(text_, text_.size()), "not JSON: the file ends too early");
  }

  static bool ends_scalar(char c) {
    return c == ',' || c == '}' || c == ']' || c == ' ' || c == '\n' || c == '\r' || c == '\t';
  }

  void skip_blanks() {
    while (at_ < text_.size() &&
           (text_[at_] == ' ' || text_[at_] == '\n' || text_[at_] == '\r' || text_[at_] == '\t'))
      ++at_;
  }
  bool accept(char c) {
    skip_blanks();
    if (!at(c)) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (accept(c)) return;
    if (at_ >= text_.size()) fail_at_end();
    fail(std::string("'") + c + "' is missing");
  }

  // Steps over a text; returns it without its quotes, escapes as they are.
  std::string_view scan_text() {
    if (!at('"')) {
      if (at_ >= text_.size()) fail_at_end();
      fail("a name in quotes is missing");
    }
    const std::size_t begin = ++at_;
    for (;;) {
      const std::size_t quote = text_.find('"', at_);
      if (quote == std::string_view::npos) fail_at_end();
      at_ = quote + 1;
      std::size_t escapes = 0;
      while (quote - escapes > begin && text_[quote - escapes - 1] == '\\') ++escapes;
      if (escapes % 2 == 0) return text_.substr(begin, quote - begin);
    }
  }

  void skip_nested() {
    std::size_t depth = 0;
    do {
      skip_blocks(depth);
      while (at_ < text_.size() && !is_mark[static_cast<unsigned char>(text_[at_])]) ++at_;
      if (at_ >= text_.size()) fail_at_end();
      const char c = text_[at_];
      if (c == '"') {
        scan_text();
        continue;
      }
      depth += c == '{' || c == '[' ? 1 : std::size_t(-1);
      ++at_;
    } while (depth > 0);
  }

  // Steps over blocks without quotes and with too few closing brackets to end the value.
  void skip_blocks(std::size_t& depth) {
    while (text_.size() - at_ >= marks_bytes) {
      const Marks marks = count_marks(text_.data() + at_);
      if (marks.quotes > 0 || marks.closing >= depth) return;
      depth = depth + marks.opening - marks.closing;
      at_ += marks_bytes;
    }
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
};

std::string_view without_quotes(std::string_view value) {
  return value.size() >= 2 && value.front() == '"' ? value.substr(1, value.size() - 2)
                                                   : std::string_view();
}

// Returns the first text of an array, or the text that a value is: CityJSON 1.0's drafts knew one
// "parent".
std::string_view find_first_text(std::string_view value) {
  const std::size_t begin = value.find('"');
  std::size_t end = begin;
  do end = end == value.npos ? end : value.find('"', end + 1);
  while (end != value.npos && value[end - 1] == '\\');
  return end == value.npos ? std::string_view() : value.substr(begin + 1, end - begin - 1);
}

}  // namespace

std::size_t line_of(std::string_view text, std::size_t place) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(place, text.size()));
  return 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n'));
}

DocumentIndex index_document(std::string_view text, const std::string& name) {
  DocumentIndex index;
  Scanner scanner(text, name);
  const auto scan_city_object = [&](std::string_view id) {
    ObjectText object;
    object.id = id;
    const std::size_t begin = scanner.place();
    if (!scanner.at('{')) {
      scanner.scan_value();
    } else {
      scanner.scan_object([&](std::string_view key) {
        const std::string_view value = scanner.scan_value();
        if (key == "type") object.type = without_quotes(value);
        if (key == "children") object.children = value;
        if (key == "parents" || key == "parent") object.parent = find_first_text(value);
      });
    }
    object.value = text.substr(begin, scanner.place() - begin);
    index.objects.push_back(object);
  };
  scanner.scan_object([&](std::string_view key) {
    if (key == "CityObjects" && scanner.at('{'))
      scanner.scan_object(scan_city_object);
    else
      index.members[std::string(key)] = scanner.scan_value();
  });
  scanner.expect_end();
  return index;
}

std::size_t ValueEnd::find(std::string_view block) {
  for (std::size_t i = 0; i < block.size(); ++i) {
    const char c = block[i];
    if (in_text_) {
      if (escaped_)
        escaped_ = false;
      else if (c == '\\')
        escaped_ = true;
      else if (c == '"')
        in_text_ = false;
      continue;
    }
    if (!is_mark[static_cast<unsigned char>(c)]) continue;
    if (c == '"') {
      in_text_ = true;
    } else if (c == '{' || c == '[') {
      ++depth_;
    } else if (depth_ <= 1) {
      return i + 1;
    } else {
      --depth_;
    }
  }
  return std::string_view::npos;
}

}  // namespace nightcity::cityjson
