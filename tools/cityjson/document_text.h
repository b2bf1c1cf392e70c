// The text of a CityJSON file, and which of the two forms it has.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "formats/mapped_file.h"
#include "tools/city/byte_source.h"

namespace nightcity::cityjson {

/// Stands before each value of a sequence by RFC 7464.
inline constexpr char record_separator = '\x1E';

/// A document as a whole: mapped where it lies plain in a file, else held in memory.
class DocumentText {
 public:
  /// `on_disk`: the document is a plain file of that name. Throws Error where it cannot be read.
  DocumentText(const city::Document& document, bool on_disk);

  /// Returns whether the document is a CityJSONSeq: a JSON value on its first line, and more behind
  /// it. Its text is then not held, so that memory does not grow with it.
  bool is_sequence() const { return is_sequence_; }
  std::string_view text() const { return text_; }

 private:
  void hold(const city::Document& document);

  std::optional<MappedFile> mapped_;
  std::string held_;
  std::string_view text_;
  bool is_sequence_ = false;
};

/// Throws Error for a line or object of more than `max_bytes`, which names the key that allows
/// more.
[[noreturn]] void refuse_long_part(const std::string& name, std::size_t line,
                                   const std::string& what, std::size_t max_bytes);

/// Reads the lines of a document, many at a time.
class LineReader {
 public:
  /// `max_line`: bytes of a line, at most.
  LineReader(const city::Document& document, std::size_t max_line)
      : name_(document.name), source_(document.open()), max_line_(max_line) {}

  /// Whole lines, followed by `padding` bytes that belong to none.
  struct Lines {
    std::unique_ptr<char[]> bytes;
    std::size_t size = 0;
    std::string_view text() const { return {bytes.get(), size}; }
    std::size_t first_line = 1;  // in the file
  };
  /// Returns none at the end. Throws Error where the document cannot be read or a line is too long.
  std::optional<Lines> next();

 private:
  std::string name_;
  std::unique_ptr<city::ByteSource> source_;
  std::size_t max_line_;
  std::string rest_;  // of a line whose end has not been read
  std::size_t line_ = 1;
  std::size_t block_ = 0;  // bytes of the last read
  bool at_end_ = false;
};

}  // namespace nightcity::cityjson
