// The lines of a Wavefront OBJ or MTL file, whatever ends them.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tools/city/byte_source.h"

namespace nightcity::obj {

class TextLines {
 public:
  /// `name`: of the file, for messages.
  TextLines(std::unique_ptr<city::ByteSource> source, std::string name);

  /// Fills `line` with the next line that is neither empty nor a comment, without blanks at its
  /// ends; false at the end. A line that ends with a backslash goes on in the next, as the format
  /// says. Lines may end with LF, CR LF or CR. The text holds until the next call. Throws Error
  /// where a line is longer than 16 MB or the file cannot be read.
  bool next(std::string_view& line);

  /// Returns the name of the file.
  const std::string& name() const { return name_; }
  /// Returns the number of the first line of what next() gave.
  std::size_t number() const { return number_; }

 private:
  bool next_physical(std::string_view& line);
  bool fill();

  std::unique_ptr<city::ByteSource> source_;
  std::string name_, joined_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;
  std::size_t physical_ = 0, number_ = 0;
  bool skip_newline_ = false;  // the LF of a CR LF
  bool is_over_ = false;
};

/// Takes the next word off the front of `text`; "" where there is none.
std::string_view take_word(std::string_view& text);

/// Takes a finite number off the front of `text`. Returns false, and leaves `text` as it was, where
/// there is none.
bool take_number(std::string_view& text, double& value);

}  // namespace nightcity::obj
