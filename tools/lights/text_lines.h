// A small text file as lines that know their numbers, for formats that are made of them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace nightcity {

class TextLines {
 public:
  struct Line {
    std::string_view text;  // without its end and blanks around it
    std::size_t number;     // from 1
  };

  /// Throws Error: missing, empty, over 16 MB (no luminaire file is), holding a zero byte (not text).
  explicit TextLines(std::filesystem::path file);

  const std::vector<Line>& all() const { return lines_; }
  const std::string& file() const { return name_; }

  /// Error at a line of this file.
  [[noreturn]] void fail(std::size_t number, const std::string& message) const;
  /// The whole text as a finite number; a decimal comma counts as a point.
  double number(std::string_view text, std::size_t line, std::string_view what) const;
  /// The same, whole and within low..high.
  int integer(std::string_view text, std::size_t line, std::string_view what, int low,
              int high) const;

 private:
  std::string name_, content_;
  std::vector<Line> lines_;
};

}  // namespace nightcity
