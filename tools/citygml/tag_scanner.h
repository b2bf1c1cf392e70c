// Finds the tags of an XML document in a moving window over its bytes: no tree, no attributes, no
// text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "tools/city/byte_source.h"

namespace nightcity::citygml {

struct Tag {
  enum class Kind : std::uint8_t { open, close, empty, end_of_file };
  Kind kind = Kind::end_of_file;
  std::size_t begin = 0, end = 0;  // from '<' to behind '>', in the window
  std::string_view name;           // with prefix; valid until the next call
};

/// Returns whether a character is white space in XML.
inline bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}
/// Returns the part of a name behind its prefix.
std::string_view local_name(std::string_view name);
/// Returns whether a tag's name ends at this character.
bool ends_name(char c);

class TagScanner {
 public:
  /// `max_window`: the most bytes that may have to be kept at once (one member).
  TagScanner(city::ByteSource& source, std::string name, std::size_t max_window);

  /// Skips text, comments, CDATA and processing instructions. Throws Error on a DOCTYPE, on markup
  /// that is no XML and where the file ends inside markup.
  Tag next();

  /// Returns whether the window holds a '<' that next() has not passed.
  bool sees_markup() const;
  /// Gives up the window, which holds no such '<', and reads on. Returns false at the end of the
  /// file.
  bool drop_text();

  /// Moves behind the element that `open` (just returned) starts and returns that position. It is
  /// found by the end tag alone, many times as fast as tag by tag. Returns 0, and moves nothing,
  /// where that is not safe: comments, CDATA or an element of the same name inside, or no end
  /// within `max_bytes`.
  std::size_t skip_element(const Tag& open, std::size_t max_bytes);

  /// The window: from the end of what was taken or replaced last to the end of what has been read.
  std::string_view window() const { return {bytes_.get(), size_}; }
  std::size_t position() const { return position_; }
  /// Gives away the window's first `end` bytes, `end` <= position(). Positions behind them move
  /// down by `end`.
  std::unique_ptr<char[]> take(std::size_t end);
  /// Puts `text`, which counts as scanned, in place of the window's first `end` bytes, `end` <=
  /// position().
  void replace(std::size_t end, std::string_view text);

  std::size_t line_of(std::size_t at);  // from 1; `at` may not lie before an earlier call's
  /// Counts the lines that follow as if there were `lines` more before them.
  void skip_lines(std::size_t lines) { line_ += lines; }
  [[noreturn]] void fail(std::size_t at, const std::string& message);
  const std::string& name() const { return name_; }

 private:
  bool fill();
  std::size_t find(char c, std::size_t from);
  std::size_t find(std::string_view text, std::size_t from);
  std::size_t end_of_tag(std::size_t begin);
  void skip_declaration(std::size_t begin);
  void skip_byte_order_mark();
  void refuse_zero_bytes(std::size_t from);
  std::unique_ptr<char[]> rebase(std::size_t end, std::string_view in_front);

  city::ByteSource& source_;
  std::string name_;
  std::size_t max_window_;
  std::size_t block_;  // to be read next
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0, capacity_ = 0;
  std::size_t position_ = 0;
  std::size_t line_ = 1, line_at_ = 0;
  bool begun_ = false;  // the first bytes have been looked at
};

}  // namespace nightcity::citygml
