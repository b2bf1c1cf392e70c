// A small text file as numbered lines, for line-based formats.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace nightcity::lights {

/// No luminaire file has more bytes.
constexpr std::size_t largest_luminaire_file = 16 << 20;

class TextLines {
 public:
  struct Line {
    std::string_view text;  // without line end and surrounding blanks
    std::size_t number;     // from 1
  };

  /// Reads a file in UTF-8 or Windows-1252, or in UTF-16 with its mark. Lines end with CR LF, LF or
  /// CR, and the text ends at a Ctrl-Z. Throws Error if it is missing, empty, larger than 16 MB (no
  /// luminaire file is) or holds a zero byte.
  explicit TextLines(std::filesystem::path file);
  /// The same of a text that lies in another file; `name` is for messages.
  TextLines(std::string name, std::string content);

  const std::vector<Line>& all() const { return lines_; }
  /// The whole text, in UTF-8.
  const std::string& text() const { return content_; }
  const std::string& file() const { return name_; }
  /// Returns the number of the line that holds a byte of text(), or of the last one before it.
  std::size_t find_line(std::size_t byte) const;

  /// Throws Error with a line of this file.
  [[noreturn]] void fail(std::size_t number, const std::string& message) const;
  /// Returns the text as a finite number; a decimal comma counts as a point. Throws Error
  /// otherwise.
  double number(std::string_view text, std::size_t line, std::string_view what) const;
  /// Returns the text as a whole number from low to high. Throws Error otherwise.
  int integer(std::string_view text, std::size_t line, std::string_view what, int low,
              int high) const;

 private:
  std::string name_, content_;
  std::vector<Line> lines_;
};

}  // namespace nightcity::lights
